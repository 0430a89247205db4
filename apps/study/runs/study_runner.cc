#include "apps/study/runs/study_runner.h"

#include "apps/analysis/analyses.h"
#include "apps/analysis/result_folder.h"
#include "apps/output/values/sensitivity_result.h"
#include "apps/scene/file/scene_override.h"
#include "apps/scene/language/parse_quantity.h"
#include "apps/session/prepared_machine.h"
#include "apps/session/session.h"
#include "apps/study/runs/output_formulas.h"
#include "apps/study/runs/scene_variants.h"

#include <cmath>
#include <ctime>
#include <stdexcept>
#include <string>

namespace gestell::apps
{
namespace
{

/// SI per unit of the variable.
double factor_of(const StudyVariable &variable)
{
  if (variable.unit.empty())
    return 1.;
  return parse_quantity("1 " + variable.unit, [](const std::string &) { return std::optional<Quantity>(); }).value;
}

/// The name under which sensitivities tell an entry of the answer.
std::string told_name(const std::vector<std::string> &path)
{
  if (path.front() == "signals" && path.size() == 3)
    return path[1] + '.' + path[2];
  if (path.front() == "modes" && path.size() == 2)
    return path[0] + '.' + path[1];
  throw std::invalid_argument("there are no derivatives of " + path.front());
}

/// Of one entry by all keys.
Eigen::VectorXd entry_derivative(const std::vector<std::string> &path, const SensitivityResult &found)
{
  const std::string name = told_name(path);
  for (const SensitivityOutput &output : found.outputs)
    if (output.output == name && output.derivative.allFinite())
      return output.derivative;
  throw std::invalid_argument("the run has no derivative of " + name);
}

/// Entries of the scene by which a run is differentiated for these variables, "parameters.c_P,parameters.s_cl".
/// @throws std::invalid_argument for a variable with several keys, words or files
std::string differentiated_keys(const std::vector<VariableRequest> &variables)
{
  std::string keys;
  for (const VariableRequest &request : variables)
  {
    if (request.keys.size() != 1 || request.variable.stepped)
      throw std::invalid_argument("variable " + request.variable.name + " has no derivatives");
    keys += (keys.empty() ? "" : ",") + request.keys.front();
  }
  return keys;
}

/**
 * Derivatives of the outputs by the levels of the variables [outputs x variables], from the sensitivities of a run by
 * differentiated_keys(): those of the entries are exact, formulas are differentiated by quotients.
 *
 * @throws std::invalid_argument for an entry without a derivative
 */
Eigen::MatrixXd output_derivatives(const OutputFormulas &outputs, const Result &result, const SceneVariants &variants,
                                   const std::vector<VariableRequest> &variables, const Eigen::VectorXd &levels)
{
  const auto *found = answer_in<SensitivityResult>(result.answers);
  if (!found || !found->failure.empty())
    throw std::invalid_argument("the run has no derivatives" + (found ? ": " + found->failure : std::string()));
  const auto                   entries = outputs.entries_of(result);
  std::vector<Eigen::VectorXd> by_key;
  for (const auto &path : outputs.paths())
    by_key.push_back(entry_derivative(path, *found));
  const auto values_beside = [&](Eigen::Index variable, double step)
  {
    Eigen::VectorXd nearby = levels;
    nearby[variable] += step;
    auto         moved = entries;
    const double in_si = step * factor_of(variables[std::size_t(variable)].variable);
    for (std::size_t e = 0; e < moved.size(); ++e)
      moved[e].value += by_key[e][variable] * in_si;
    const auto      values = outputs.values_of(moved, variants.parameters_at(nearby), nearby);
    Eigen::VectorXd column(values.size());
    for (std::size_t i = 0; i < values.size(); ++i)
      column[Eigen::Index(i)] = values[i].value;
    return column;
  };
  Eigen::MatrixXd derivatives;
  for (Eigen::Index i = 0; i < levels.size(); ++i)
  {
    // of the range of a variable, for quotients of formulas: rounding is 1e-10 then, curvature 1e-12
    constexpr double      formula_step = 1e-6;
    const double          step         = formula_step * variables[std::size_t(i)].variable.half_range();
    const Eigen::VectorXd column       = (values_beside(i, step) - values_beside(i, -step)) / (2. * step);
    derivatives.conservativeResize(column.size(), levels.size());
    derivatives.col(i) = column;
  }
  return derivatives;
}

/// [s] of the processor that this process took so far.
double cpu_of_process()
{
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

RunRow failed(RunRow row, const std::string &message)
{
  row.status  = RunStatus::failed;
  row.message = message;
  return row;
}

} // namespace

StudyRunner::StudyRunner(const StudyFile &study, const Eigen::MatrixXd &levels, fem::Scripts scripts,
                         const std::filesystem::path &kept)
    : variables_(study.variables), variants_(study, scripts), frames_(!kept.empty()),
      outputs_((variants_.check_ranges(levels), study), variants_.at(variants_.middle()).scene(),
               variants_.parameters_at(variants_.middle())),
      measures_(study.measures), kept_(kept)
{
  const Scene scene = variants_.at(variants_.middle()).scene();
  for (const RunParameter &measure : measures_)
    try
    {
      answer_entry::check(key_segments(measure.entry, measure.place), scene);
    }
    catch (const std::invalid_argument &error)
    {
      measure.place.fail("scene.measure." + measure.parameter + ": " + error.what());
    }
}

void StudyRunner::leave_out_unread(Scene &scene) const
{
  std::vector<std::string> read = outputs_.signals();
  for (const RunParameter &measure : measures_)
    if (const auto segments = key_segments(measure.entry, measure.place); segments.front() == "signals")
      read.push_back(segments[1]);
  keep_signals(scene, read);
  coupling::RunOptions &run = scene.run.options;
  run.picture_step          = 0.; // rows stay: extremes are looked for at them, too
  run.energy                = outputs_.reads("energy");
}

/// Sets the measured parameters by a run; whether it was made with these values already.  An event that it did not
/// reach is looked for until twice the time.
bool StudyRunner::measure(const Result &result, const Eigen::VectorXd &levels)
{
  bool settled = true;
  for (const RunParameter &measure : measures_)
  {
    const double used     = variants_.measured(measure, levels);
    AnswerValue  reported = answer_entry::value(key_segments(measure.entry, measure.place), result);
    if (!std::isfinite(reported.value))
      reported.value = 2. * used;
    constexpr double settled_to = 1e-9; // of such a parameter: what runs scatter by
    settled                     = settled && std::abs(reported.value - used) <= settled_to * std::abs(reported.value);
    variants_.set_measured(measure, reported.value, reported.unit);
  }
  return settled;
}

/// Runs until what it tells of its own parameters is what it was made with.
Result StudyRunner::settled_result(const Eigen::VectorXd &levels, const std::atomic<bool> *stop,
                                   const std::string &sensitivities)
{
  for (int attempt = 1;; ++attempt)
  {
    Result result = single_result(levels, stop, sensitivities);
    if (measures_.empty() || result.run->interrupted || !result.run->failure.empty() || measure(result, levels))
      return result;
    constexpr int most_attempts = 5; // to find what a run tells of its own parameters
    if (attempt == most_attempts)
      throw std::invalid_argument(measures_.front().place.text() + ": scene.measure: after " +
                                  std::to_string(most_attempts) +
                                  " runs the parameter values have not converged; check that the event occurs");
  }
}

/// From the same guess, whichever run this process made before.
void StudyRunner::settle(const Eigen::VectorXd &levels, const std::atomic<bool> *stop)
{
  if (!measures_.empty())
    result_of(levels, stop, "");
}

Result StudyRunner::result_of(const Eigen::VectorXd &levels, const std::atomic<bool> *stop,
                              const std::string &sensitivities)
{
  if (!measures_.empty() && guesses_.empty())
  {
    Result middle = settled_result(variants_.middle(), stop, "");
    if (middle.run->interrupted || !middle.run->failure.empty())
      return middle;
    for (const RunParameter &measure : measures_)
      guesses_.push_back(answer_entry::value(key_segments(measure.entry, measure.place), middle));
  }
  for (std::size_t i = 0; i < measures_.size(); ++i)
    variants_.set_measured(measures_[i], guesses_[i].value, guesses_[i].unit);
  return settled_result(levels, stop, sensitivities);
}

Result StudyRunner::single_result(const Eigen::VectorXd &levels, const std::atomic<bool> *stop,
                                  const std::string &sensitivities)
{
  Variant variant = variants_.at(levels);
  Scene   scene   = variant.scene();
  if (kept_.empty() && sensitivities.empty()) // the scenes just beside have all signals
    leave_out_unread(scene);
  const auto frame = frames_.frame(scene, stoppable({}, stop));
  Session    session(std::move(variant), std::move(scene), {{}, stop});
  if (frame)
    session.use_frame(*frame);
  const Analyses analyses = analyses_of("run", {{"--sensitivities", {sensitivities}}});
  const bool answers = !kept_.empty() || session.scene().life; // of a run, for its report and as outputs of the study
  return answers ? complete_run(session, analyses) : run_with(analyses, session);
}

void StudyRunner::keep(int number, const Result &result) const
{
  const std::filesystem::path folder = kept_ / run_folder(number);
  prepare_folder(folder);
  write_results(folder, result);
}

RunRow StudyRunner::run(int number, const Eigen::VectorXd &levels, const std::atomic<bool> *stop,
                        Eigen::MatrixXd *derivatives)
{
  RunRow row;
  row.run                     = number;
  const double          begin = cpu_of_process();
  const auto            spent = [&] { return cpu_of_process() - begin; };
  std::optional<Result> result;
  try
  {
    result = result_of(levels, stop, derivatives ? differentiated_keys(variables_) : "");
  }
  catch (const std::exception &error) // of this run; the others go on
  {
    row.cpu_s = spent();
    return stop && *stop ? row : failed(row, error.what());
  }
  if (!kept_.empty())
    keep(number, *result);
  if (result->run->interrupted)
    return row;
  if (!result->run->failure.empty())
  {
    row.cpu_s = spent();
    return failed(row, result->run->failure);
  }
  if (derivatives)
    *derivatives = derivatives_or_none(*result, levels);
  row.cpu_s = spent();
  read_outputs(*result, levels, row);
  return row;
}

/// What is wrong for all runs is told apart from a formula that has no value in this one.
void StudyRunner::read_outputs(const Result &result, const Eigen::VectorXd &levels, RunRow &row)
{
  const Parameters parameters = variants_.parameters_at(levels);
  row.lacks_output            = true;
  try
  {
    const std::vector<AnswerValue> entries = outputs_.entries_of(result);
    if (!units_checked_)
      outputs_.check_units(entries, parameters, levels);
    units_checked_   = true;
    row.lacks_output = false;
    for (const AnswerValue &value : outputs_.values_of(entries, parameters, levels))
    {
      row.values.push_back(value.value);
      row.units.push_back(value.unit);
    }
    row.status = RunStatus::done;
  }
  catch (const std::invalid_argument &error)
  {
    row.values.clear();
    row.units.clear();
    row.status  = RunStatus::failed;
    row.message = error.what();
  }
}

Eigen::MatrixXd StudyRunner::derivatives_or_none(const Result &result, const Eigen::VectorXd &levels) const
{
  if (!measures_.empty()) // they vary, too
    return {};
  try
  {
    return output_derivatives(outputs_, result, variants_, variables_, levels);
  }
  catch (const std::invalid_argument &)
  {
    return {};
  }
}

std::string run_folder(int number)
{
  return "run_" + std::to_string(number);
}

} // namespace gestell::apps
