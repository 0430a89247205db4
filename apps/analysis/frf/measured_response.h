#pragma once

#include "apps/analysis/frf/frequency_response.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/**
 * Measured curves from files, each "FILE" or "PAIR=FILE" with a pair as it is named in frf.csv ("tip.ux/motor.uy"):
 * tables (.csv) of frequency and value, or universal files (.uff, .unv) with data sets 58.  Curves without a name are
 * taken for the pairs in their order.
 *
 * @throws std::invalid_argument with file, line and what is needed
 */
std::vector<MeasuredResponse> measured_responses(const std::vector<std::string> &files,
                                                 const FrequencyResponse        &response);

} // namespace gestell::apps
