#pragma once

#include "apps/output/values/sensitivity_result.h"

#include <string>

namespace gestell::apps
{

/// `output, key, derivative, unit, change by 1 %, note`: a row for each output and key; `change by 1 %` is the relative
/// change of the output in percent, empty where it is zero; derivatives that do not exist are empty; `note` tells why,
/// or how the frame's share was found where a key changes it.
std::string sensitivities_csv(const SensitivityResult &result);

/// For a terminal: what moves each largest and smallest value most.
std::string sensitivities_text(const SensitivityResult &result);

/// "N/(kg/s^2)"
std::string derivative_unit(const SensitivityOutput &output, const SensitivityKey &key);

/// Keys of an output, that with the largest change by 1 % first; those without any are left out.
std::vector<Eigen::Index> by_influence(const SensitivityResult &result, const SensitivityOutput &output);

} // namespace gestell::apps
