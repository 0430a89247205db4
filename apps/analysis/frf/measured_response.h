#pragma once

#include "apps/analysis/frf/frequency_response.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/**
 * Measured curves from files, each "FILE" or "PAIR=FILE" with the name of a pair in frf.csv ("tip.ux/motor.uy"): tables
 * (.csv) of frequency and value, or universal files (.uff, .unv) with data sets 58.  Curves without a name are assigned
 * to the pairs in order.
 *
 * @throws std::invalid_argument with file, line and the requirement
 */
std::vector<MeasuredResponse> measured_responses(const std::vector<std::string> &files,
                                                 const FrequencyResponse        &response);

} // namespace gestell::apps
