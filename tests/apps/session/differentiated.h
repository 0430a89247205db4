#pragma once

#include "apps/analysis/analyses.h"
#include "apps/output/values/sensitivity_result.h"

#include <stdexcept>
#include <string>

namespace gestell::tests
{

/// A run with its derivatives by these entries of the scene.
inline apps::Result differentiated(apps::Session &&session, const std::string &keys)
{
  return apps::run_with(apps::analyses_of("run", {{"--sensitivities", {keys}}}), session);
}

inline const apps::SensitivityResult &sensitivities_of(const apps::Result &result)
{
  const auto *found = apps::answer_in<apps::SensitivityResult>(result.answers);
  return found ? *found : throw std::runtime_error("no sensitivities: " + result.run->failure);
}

} // namespace gestell::tests
