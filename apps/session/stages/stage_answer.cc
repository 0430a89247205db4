#include "apps/session/stages/stage_answer.h"

#include "apps/session/stages/matrix_pencil.h"
#include "coupling/equilibrium/static_equilibrium.h"
#include "coupling/machine/configuration/assembly.h"
#include "coupling/modes/modes.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace gestell::apps
{

namespace
{

using coupling::Event;
using coupling::RunResult;

constexpr double  nan           = std::numeric_limits<double>::quiet_NaN();
constexpr int     most_modes    = 60;  ///< of the linearised machine that are looked at
constexpr double  most_samples  = 300; ///< of the pencil, whose cost grows with their cube
constexpr long    least_samples = 40;
constexpr double  near          = 0.25; ///< relative distance of frequencies beyond which modes are no pair
const char *const contacts[]    = {"lift_off", "touch_down", "closes", "opens"};

bool is_border(const Event &event, const std::string &border)
{
  return event.name == border || event.name + "." + event.kind == border;
}

/// Rows of the history, as many as there are.
class Rows
{
public:
  explicit Rows(const RunResult &run) : run_(run), width_(run.columns.size()) {}

  std::size_t size() const { return width_ > 0 ? run_.rows.size() / width_ : 0; }
  double      t(std::size_t i) const { return run_.rows[i * width_]; }
  double      at(std::size_t i, std::size_t column) const { return run_.rows[i * width_ + column]; }
  /// @return 0, the time, if there is none
  std::size_t column(const std::string &name) const
  {
    const auto found = std::find(run_.columns.begin(), run_.columns.end(), name);
    return found == run_.columns.end() ? 0 : std::size_t(found - run_.columns.begin());
  }
  const std::string &unit(std::size_t column) const { return run_.units[column]; }

private:
  const RunResult &run_;
  std::size_t      width_;
};

StageExtremes extremes_of(const Rows &rows, const std::string &signal, const Stage &stage)
{
  const std::size_t column = rows.column(signal);
  StageExtremes     found{signal, rows.unit(column), nan, nan, nan, nan};
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    const double t = rows.t(i), y = rows.at(i, column);
    if (t < stage.begin || t > stage.end)
      continue;
    if (!(found.min <= y))
      found.min = y, found.t_min = t;
    if (!(found.max >= y))
      found.max = y, found.t_max = t;
  }
  return found;
}

/// Where a border was missed: how far the signal of its switch came.
std::string unreached(const Scene &scene, const std::string &border, const RunResult &run)
{
  std::string text = scene.stages.place + ": the run never came to the border '" + border + "'";
  const auto  own  = std::find_if(scene.switches.begin(), scene.switches.end(),
                                  [&](const SwitchRequest &any)
                                  { return any.request.name == border || any.request.name + ".switch" == border; });
  if (own == scene.switches.end())
    return text + ": it has no such event; the events of a run are listed in its report and in summary.json";
  const bool rises  = own->request.crossing != coupling::SwitchCrossing::falling;
  const auto signal = std::find_if(scene.signals.begin(), scene.signals.end(),
                                   [&](const SignalRequest &any) { return any.path == own->request.signal; });
  if (const Rows rows(run); signal != scene.signals.end() && rows.size() > 0)
  {
    const Stage         all{"", rows.t(0), rows.t(rows.size() - 1), {}};
    const StageExtremes found = extremes_of(rows, signal->name, all);
    text += ": " + own->request.signal + " comes to " + rounded(rises ? found.max : found.min) + " " + found.unit +
            " at " + rounded(rises ? found.t_max : found.t_min) + " s";
  }
  return text + ", the switch needs " + rounded(own->request.level) + " (" + own->place +
         "); give the switch a value that is reached, or the run more time (run.end)";
}

/// A first stage of no length.
std::string over_at_start(const Scene &scene, const std::string &border)
{
  std::string text = scene.stages.place + ": the stage '" + scene.stages.names.front() + "' is over at the start, '" +
                     border + "' happens there";
  for (const SwitchRequest &own : scene.switches)
    if (own.request.name == border)
      text += ": " + own.request.signal + " lies at or beyond " + rounded(own.request.level) + " already (" +
              own.place + "); start from where it does not, or give the switch another value";
  return text;
}

/// @return why they are fewer than asked for; empty: they are not
std::string add_stages(const Scene &scene, const RunResult &run, StageResult &result)
{
  const Rows        rows(run);
  const double      begin = rows.t(0), end = rows.t(rows.size() - 1);
  double            from  = begin;
  auto              event = run.events.begin();
  std::string       reason;
  const std::size_t n = scene.stages.names.size();
  for (std::size_t i = 0; i < n && reason.empty(); ++i)
  {
    Stage stage{scene.stages.names[i], from, end, {}};
    if (i + 1 < n)
    {
      const std::string &border = scene.stages.borders[i];
      event = std::find_if(event, run.events.end(), [&](const Event &any) { return is_border(any, border); });
      if (event == run.events.end())
        reason = unreached(scene, border, run);
      else
      {
        if (i == 0 && event->t <= begin)
          return over_at_start(scene, border);
        stage.end = from = event->t;
        ++event;
      }
    }
    for (const SignalRequest &signal : scene.signals)
      stage.extremes.push_back(extremes_of(rows, signal.name, stage));
    result.stages.push_back(std::move(stage));
  }
  return reason;
}

/// From the last event of a contact on.
double ringing_begin(const RunResult &run, const Stage &last)
{
  double begin = last.begin;
  for (const Event &event : run.events)
    if (std::find(std::begin(contacts), std::end(contacts), event.kind) != std::end(contacts))
      begin = std::max(begin, event.t);
  return begin;
}

/// Samples at equal times; rows beside the grid, as at events, are left out.
Eigen::MatrixXd samples_of(const Rows &rows, double output_step, Ringing &ringing)
{
  const double every = std::max(1., std::floor((ringing.end - ringing.begin) / output_step / most_samples));
  std::vector<std::vector<double>> taken(ringing.signals.size());
  ringing.step = every * output_step;
  double next  = std::ceil(ringing.begin / output_step + 1e-6) * output_step;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (std::abs(rows.t(i) - next) < 1e-6 * output_step)
    {
      for (std::size_t s = 0; s < taken.size(); ++s)
        taken[s].push_back(rows.at(i, rows.column(ringing.signals[s])));
      next += ringing.step;
    }
  Eigen::MatrixXd samples(Eigen::Index(taken.front().size()), Eigen::Index(taken.size()));
  for (Eigen::Index s = 0; s < samples.cols(); ++s)
    samples.col(s) = Eigen::VectorXd::Map(taken[std::size_t(s)].data(), samples.rows());
  return samples;
}

/// Modes of the machine at rest where its driven joints stand at that state.
std::vector<coupling::Mode> modes_at_rest(PreparedMachine &prepared, const Eigen::VectorXd &end_state, double t)
{
  coupling::Machine   &machine = prepared.machine;
  coupling::KnownStart known;
  known.state.t = t;
  known.state.q = end_state;
  known.state.v = Eigen::VectorXd::Zero(machine.size());
  known.q_given.assign(std::size_t(machine.size()), 0);
  known.v_given = known.q_given;
  coupling::LocalState local;
  local.resize(machine);
  machine.gather(t, known.state.q, known.state.v, known.state.v, local);
  machine.events().start(local);
  Eigen::VectorXd              g(machine.joints().n_rows());
  coupling::ConstraintJacobian G(machine.joints().blocks());
  machine.joints().constraints(local, g, G);
  for (Eigen::Index row = 0; row < g.size(); ++row)
    known.shifts.emplace_back(int(row), g[row]);
  const Eigen::VectorXd q = coupling::held_equilibrium(machine, known).q;
  machine.gather(t, q, known.state.v, known.state.v, local);
  machine.events().start(local);
  return coupling::coupled_modes(machine, q, {}, most_modes);
}

/// The nearest of those that move what rings.
void pair_up(const std::vector<coupling::Mode> &modes, RingingMode &mode)
{
  double least = near;
  for (std::size_t j = 0; j < modes.size(); ++j)
    if (modes[j].damped_frequency_hz > 0.)
      if (const double away = std::abs(modes[j].damped_frequency_hz / mode.frequency_hz - 1.); away < least)
      {
        least                 = away;
        mode.linearised       = int(j);
        mode.linearised_hz    = modes[j].damped_frequency_hz;
        mode.linearised_ratio = modes[j].damping_ratio;
      }
}

void identify(const Scene &scene, PreparedMachine &prepared, const Eigen::VectorXd &end_state, const RunResult &run,
              StageResult &result)
{
  const Rows rows(run);
  Ringing   &ringing = result.ringing;
  ringing.begin      = ringing_begin(run, result.stages.back());
  ringing.end        = result.stages.back().end;
  ringing.signals    = scene.stages.ringing;
  for (const std::string &signal : ringing.signals)
    ringing.units.push_back(rows.unit(rows.column(signal)));
  const Eigen::MatrixXd samples = samples_of(rows, coupling::output_step(scene.run.options), ringing);
  if (samples.rows() < least_samples)
  {
    result.reason = "too few rows of the history lie behind the last contact, at " + rounded(ringing.begin) +
                    " s; modes need " + std::to_string(least_samples) + ", there are " +
                    std::to_string(samples.rows()) + ": give run.end a larger or output.step a smaller value";
    return;
  }
  const PencilFit fit = matrix_pencil(samples, ringing.step, scene.stages.modes);
  ringing.residual    = fit.residual;
  std::vector<coupling::Mode> modes;
  try
  {
    modes = modes_at_rest(prepared, end_state, scene.run.options.begin);
  }
  catch (const std::exception &none)
  {
    result.reason = std::string("no modes to compare with: ") + none.what();
  }
  for (const DampedOscillation &found : fit.oscillations)
  {
    RingingMode mode;
    mode.frequency_hz  = found.frequency_hz();
    mode.damping_ratio = found.damping_ratio();
    for (Eigen::Index s = 0; s < found.amplitudes.size(); ++s)
      mode.amplitudes.push_back(std::abs(found.amplitudes[s]));
    pair_up(modes, mode);
    ringing.modes.push_back(std::move(mode));
  }
}

} // namespace

std::vector<LiftOff> lift_off_intervals(const RunResult &run, double begin, double end)
{
  std::vector<LiftOff>     intervals;
  std::vector<std::string> seen; // wheels with an event
  for (const Event &event : run.events)
  {
    if (event.kind != "lift_off" && event.kind != "touch_down")
      continue;
    const bool first = std::find(seen.begin(), seen.end(), event.name) == seen.end();
    if (first)
      seen.push_back(event.name);
    if (event.kind == "lift_off")
      intervals.push_back({event.name, event.t, end});
    else if (first)
      intervals.push_back({event.name, begin, event.t});
    else
      std::find_if(intervals.rbegin(), intervals.rend(), [&](const LiftOff &any) { return any.wheel == event.name; })
          ->end = event.t;
  }
  return intervals;
}

std::optional<StageResult> stage_answer(const Scene &scene, PreparedMachine &prepared, const Eigen::VectorXd &end_state,
                                        RunResult &run)
{
  const Rows rows(run);
  if (rows.size() == 0)
    return std::nullopt;
  StageResult result;
  result.lift_offs = lift_off_intervals(run, rows.t(0), rows.t(rows.size() - 1));
  if (!scene.stages.given() && result.lift_offs.empty())
    return std::nullopt;
  if (!scene.stages.given())
    return result;
  const std::string missing = add_stages(scene, run, result);
  if (!missing.empty())
  {
    result.reason = missing;
    if (run.failure.empty() && !run.interrupted)
      run.failure = missing;
  }
  else if (!scene.stages.ringing.empty() && run.failure.empty() && prepared.machine.size() == end_state.size())
    identify(scene, prepared, end_state, run, result);
  return result;
}

} // namespace gestell::apps
