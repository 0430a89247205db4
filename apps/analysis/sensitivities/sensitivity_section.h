#pragma once

#include "apps/output/report/section.h"
#include "apps/output/values/sensitivity_result.h"

namespace gestell::apps
{

/// `output, key, derivative, unit, change by 1 %, note`: a row for each output and key. `change by 1 %` is the relative
/// change of the output in percent, empty if the output is zero. Missing derivatives are empty fields. `note` gives the
/// reason, or the method for the frame's part if the key changes the frame. "" if the derivatives of the run failed.
std::string sensitivities_csv(const SensitivityResult &result);

/// For the largest and smallest values of signals a tornado chart and a table of their changes if a key increases by 1
/// %; only on the page a table of all other outputs.
std::vector<Section> sections_of(const Result &result, const SensitivityResult &found);

} // namespace gestell::apps
