#pragma once

#include "apps/output/text/svg.h"
#include "apps/output/values/result.h"

#include <string>

namespace gestell::apps
{

/// Spectra of the chosen signals with the natural frequencies and the orders of the drive; "" without spectra.
std::string spectrum_section(const Result &result, Pictures &pictures);

} // namespace gestell::apps
