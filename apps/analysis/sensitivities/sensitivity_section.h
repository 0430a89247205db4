#pragma once

#include "apps/output/report/section.h"
#include "apps/output/values/sensitivity_result.h"

namespace gestell::apps
{

/// `output, key, derivative, unit, change by 1 %, note`: a row for each output and key; `change by 1 %` is the relative
/// change of the output in percent, empty where it is zero; derivatives that do not exist are empty; `note` states why,
/// or how the frame's share was found where a key changes it.  "" of a run whose derivatives failed.
std::string sensitivities_csv(const SensitivityResult &result);

/// For the largest and smallest values of signals a tornado and a table of what 1 % more of a key changes; a table of
/// all other outputs for the page alone.
std::vector<Section> sections_of(const Result &result, const SensitivityResult &found);

} // namespace gestell::apps
