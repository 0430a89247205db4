#include "apps/analysis/analysis_entry.h"
#include "apps/analysis/sensitivities/sensitivity_section.h"
#include "apps/session/sensitivity/perturbed_scenes.h"
#include "coupling/sensitivity/frequency_sensitivities.h"
#include "coupling/sensitivity/run_sensitivities.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <ctime>

namespace gestell::apps
{

template <class Visitor>
void describe_answer(Visitor &v, const SensitivityResult &x)
{
  v.maybe(true, "sensitivities", x, "", "`run --sensitivities`");
}

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
    PreparedScene &below = twins.scenes[2 * k], &above = twins.scenes[2 * k + 1];
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

/// Derivatives of all scalar results of a run: docs/theory/sensitivities.md.  `result` contains the run; warnings are
/// added.
SensitivityResult differentiated(RunInProgress &in, PerturbedScenes &twins, const std::vector<VariedKey> &keys)
{
  Result           &result = in.result;
  SensitivityResult found;
  for (const VariedKey &key : keys)
    found.keys.push_back(key.reported);
  coupling::RunSensitivities run;
  SensitivityResult          frequencies;
  try
  {
    add_frequencies(twins, result, frequencies);
    run = coupling::run_sensitivities({in.session.machine().machine, in.signals, in.session.scene().run.options,
                                       *result.run, in.trajectory, twins.twins, in.session.interruption()});
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
    result.warnings.push_back("interrupted: sensitivities cover the motion up to t = " + short_text(run.reached) +
                              " s");
  }
  for (SensitivityOutput &output : frequencies.outputs)
    found.outputs.push_back(std::move(output));
  result.warnings.insert(result.warnings.end(), run.warnings.begin(), run.warnings.end());
  if (!run.interrupted)
    warn_of_idle_keys(found, result.warnings);
  return found;
}

/// Its derivatives follow the whole motion.
class Sensitivities : public Analysis
{
public:
  std::vector<CommandOption> options() override
  {
    return {
        {"--sensitivities", &list_,
         "derivatives of peaks, instants, events, final values and frequencies with respect to scene parameters, such "
         "as parameters.c_P,parameters.s_cl, or all (every number of [parameters])"}};
  }
  bool        requested(const Scene &) const override { return !list_.empty(); }
  std::string needs_trajectory() const override { return "--sensitivities"; }
  void        check(Session &session) override
  {
    left_out_.clear();
    keys_ = varied_keys(session.variant().root, list_, &left_out_);
  }
  void before_motion(RunInProgress &run) override
  {
    outcome_                 = AnalysisOutcome::done;
    const std::clock_t begin = std::clock();
    twins_ = perturbed_scenes(run.session.variant(), run.session.scene(), run.session.machine(), keys_,
                              list_ == "all" ? &left_out_ : nullptr, run.session.progress());
    for (const auto *warnings : {&left_out_, &twins_.warnings})
      run.result.warnings.insert(run.result.warnings.end(), warnings->begin(), warnings->end());
    at_run_ = std::clock();
    before_ = at_run_ - begin;
  }
  void after_motion(RunInProgress &run) override
  {
    PerturbedScenes twins = std::move(twins_); // two machines per key, used only here
    if (!run.result.run->failure.empty() || run.result.run->interrupted)
      return;
    const std::clock_t begin = std::clock();
    run.session.progress()("sensitivities", -1.);
    SensitivityResult found = differentiated(run, twins, keys_);
    found.run_cpu_s         = double(begin - at_run_) / CLOCKS_PER_SEC;
    found.cpu_s             = double(before_ + std::clock() - begin) / CLOCKS_PER_SEC;
    if (!found.failure.empty())
      run.result.warnings.push_back("sensitivities were not computed: " + found.failure);
    outcome_ = !found.failure.empty() ? AnalysisOutcome::failed
               : found.interrupted    ? AnalysisOutcome::interrupted
                                      : AnalysisOutcome::done;
    run.result.answers.push_back(as_answer(std::move(found)));
  }
  AnalysisOutcome compute(Session &, Result &) const override { return outcome_; }

private:
  std::string              list_;
  std::vector<VariedKey>   keys_;
  std::vector<std::string> left_out_;
  PerturbedScenes          twins_;
  std::clock_t             at_run_ = 0, before_ = 0;
  AnalysisOutcome          outcome_ = AnalysisOutcome::done;
};

} // namespace

AnalysisEntry sensitivity_analysis()
{
  return analysis_entry<Sensitivities, SensitivityResult>(
      "sensitivities", "", {},
      {{"sensitivities.csv", "derivatives of peaks, instants, events and frequencies, with `run --sensitivities`",
        content_of<SensitivityResult, sensitivities_csv>}},
      "run");
}

} // namespace gestell::apps
