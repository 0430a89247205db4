#include "apps/session/sensitivity/sensitivity_answer.h"

#include "coupling/sensitivity/run_sensitivities.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{

namespace
{
using Eigen::VectorXd;

void warn_of_idle_keys(const SensitivityResult &found, std::vector<std::string> &warnings)
{
  for (std::size_t k = 0; k < found.keys.size(); ++k)
  {
    const auto moves = [&](const SensitivityOutput &output)
    {
      const double change = std::abs(output.derivative[Eigen::Index(k)] * found.keys[k].value);
      return std::isfinite(change) && change > 1e-9 * std::abs(output.value);
    };
    if (std::none_of(found.outputs.begin(), found.outputs.end(), moves))
      warnings.push_back(found.keys[k].key + " has no influence on any output of this run");
  }
}

} // namespace

SensitivityResult sensitivity_answer(const Scene &scene, PreparedMachine &prepared, SceneTwins &twins,
                                     const std::vector<VariedKey>        &keys,
                                     const std::vector<coupling::Signal> &signals,
                                     const coupling::Trajectory &trajectory, Result &result)
{
  SensitivityResult found;
  for (const VariedKey &key : keys)
    found.keys.push_back(key.told);
  const coupling::RunSensitivities run = coupling::run_sensitivities(
      {prepared.machine, signals, scene.run.options, *result.run, trajectory, twins.twins});
  for (const coupling::OutputDerivatives &output : run.outputs)
    found.outputs.push_back({output.output, output.unit, output.note, output.value, output.derivative});
  found.steps = run.steps;
  result.warnings.insert(result.warnings.end(), run.warnings.begin(), run.warnings.end());
  warn_of_idle_keys(found, result.warnings);
  return found;
}

} // namespace gestell::apps
