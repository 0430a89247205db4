#include "apps/session/sensitivity/sensitivity_answer.h"

#include "coupling/sensitivity/frequency_sensitivities.h"
#include "coupling/sensitivity/run_sensitivities.h"
#include "fem/values/number_text.h"

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

/// Before the twins are run.
void add_frequencies(PerturbedScenes &twins, const Result &result, SensitivityResult &found)
{
  const auto at = [](const Scene &of, coupling::Machine &machine) {
    return coupling::LinearisedAt{&machine, modes_configuration(of, machine), &of.modes.open};
  };
  std::vector<coupling::FrequencyTwins> sides;
  for (std::size_t k = 0; k < twins.twins.size(); ++k)
  {
    SceneTwin &below = twins.scenes[2 * k], &above = twins.scenes[2 * k + 1];
    sides.push_back(
        {at(*below.scene, below.prepared->machine), at(*above.scene, above.prepared->machine), twins.twins[k].step});
  }
  const Eigen::MatrixXd slopes = coupling::frequency_sensitivities(result.coupled_modes, sides);
  for (std::size_t j = 0; j < result.coupled_modes.size(); ++j)
  {
    const std::string why = coupling::without_derivative(result.coupled_modes, j);
    found.outputs.push_back({"modes." + std::to_string(j + 1), "Hz", why.empty() ? "" : "no derivative: " + why,
                             result.coupled_modes[j].frequency_hz, slopes.row(Eigen::Index(j)).transpose(),
                             result.coupled_modes[j].frequency_hz == 0.});
  }
}

} // namespace

SensitivityResult sensitivity_answer(const Scene &scene, PreparedMachine &prepared, PerturbedScenes &twins,
                                     const std::vector<VariedKey> &keys, const std::vector<coupling::Signal> &signals,
                                     const coupling::Trajectory &trajectory, const std::atomic<bool> *stop,
                                     Result &result)
{
  SensitivityResult found;
  for (const VariedKey &key : keys)
    found.keys.push_back(key.reported);
  coupling::RunSensitivities run;
  SensitivityResult          frequencies;
  try
  {
    add_frequencies(twins, result, frequencies);
    run = coupling::run_sensitivities(
        {prepared.machine, signals, scene.run.options, *result.run, trajectory, twins.twins, stop});
  }
  catch (const std::exception &none) // of this motion: what was computed of it stays
  {
    found.failure = none.what();
    return found;
  }
  for (const coupling::OutputDerivatives &output : run.outputs)
    found.outputs.push_back({output.output, output.unit, output.note, output.value, output.derivative, output.is_zero});
  found.steps = run.steps;
  if (run.interrupted)
  {
    found.interrupted = true;
    result.warnings.push_back(
        "interrupted: sensitivities are known of what lies before t = " + short_text(run.reached) + " s of the motion");
  }
  for (SensitivityOutput &output : frequencies.outputs)
    found.outputs.push_back(std::move(output));
  result.warnings.insert(result.warnings.end(), run.warnings.begin(), run.warnings.end());
  if (!run.interrupted)
    warn_of_idle_keys(found, result.warnings);
  return found;
}

} // namespace gestell::apps
