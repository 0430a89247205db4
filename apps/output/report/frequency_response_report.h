#pragma once

#include "apps/output/text/svg.h"
#include "apps/output/values/result.h"

#include <string>

namespace gestell::apps
{

/// Amplitude and phase over frequency, pairs of one unit in a chart, measured curves as dots beside them.
Pictures frequency_response_pictures(const FrequencyResponse &response);

/// The section of the report; adds its pictures.  "" without such a result.
std::string frequency_response_section(const Result &result, Pictures &pictures);

} // namespace gestell::apps
