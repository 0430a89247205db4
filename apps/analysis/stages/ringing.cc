#include "apps/analysis/stages/ringing.h"

#include "apps/session/history_rows.h"
#include "coupling/equilibrium/static_equilibrium.h"
#include "coupling/machine/configuration/assembly.h"
#include "coupling/modes/matrix_pencil.h"
#include "coupling/modes/modes.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gestell::apps
{

namespace
{

using coupling::DampedOscillation;
using coupling::Event;
using coupling::RunResult;

const char *const contacts[] = {"lift_off", "touch_down", "closes", "opens"};

/// After the last event of a contact.
double ringing_begin(const RunResult &run, const Stage &last)
{
  double begin = last.begin;
  for (const Event &event : run.events)
    if (std::find(std::begin(contacts), std::end(contacts), event.kind) != std::end(contacts))
      begin = std::max(begin, event.t);
  return begin;
}

/// Samples at equal times; rows off the grid, as at events, are omitted.
Eigen::MatrixXd samples_of(const HistoryRows &rows, double output_step, Ringing &ringing)
{
  constexpr double most_samples = 300; // samples in the pencil; the cost grows with their cube
  const double     every        = std::max(1., std::floor((ringing.end - ringing.begin) / output_step / most_samples));
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

/// Modes of the machine at rest with its driven joints in the position of that state.
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
  constexpr int most_modes = 60; // of the linearised machine that are compared
  return coupling::coupled_modes(machine, q, {}, most_modes);
}

/// The nearest of those that move what rings.
void pair_up(const std::vector<coupling::Mode> &modes, RingingMode &mode)
{
  // relative distance of frequencies beyond which modes do not match: chosen
  constexpr double near  = 0.25;
  double           least = near;
  for (std::size_t j = 0; j < modes.size(); ++j)
    if (modes[j].damped_frequency_hz > 0.)
      if (const double away = std::abs(modes[j].damped_frequency_hz / mode.frequency_hz - 1.); away < least)
      {
        least           = away;
        mode.linearised = {int(j) + 1, modes[j].damped_frequency_hz, modes[j].damping_ratio};
      }
}

/// Label as a combination of stronger ones; empty: it is none.
std::string combination(const DampedOscillation &own, const std::vector<DampedOscillation> &stronger)
{
  constexpr double combined = 0.015; // relative distance of poles within which one is a combination
  const auto       is       = [&](std::complex<double> s) { return std::abs(own.s - s) < combined * std::abs(own.s); };
  const auto       hz       = [](const DampedOscillation &any) { return short_text(any.frequency_hz()); };
  for (const DampedOscillation &any : stronger)
    for (int k = 2; k <= 4; ++k)
      if (is(double(k) * any.s))
        return std::to_string(k) + " x " + hz(any) + " Hz";
  for (const DampedOscillation &any : stronger)
    for (const DampedOscillation &other : stronger)
    {
      if (is(any.s + other.s))
        return hz(any) + " + " + hz(other) + " Hz";
      if (is(any.s + std::conj(other.s)))
        return hz(any) + " - " + hz(other) + " Hz";
    }
  return "";
}

RingingMode ringing_mode(const DampedOscillation &found, const std::vector<std::string> &signals)
{
  RingingMode mode;
  mode.frequency_hz  = found.frequency_hz();
  mode.damping_ratio = found.damping_ratio();
  for (std::size_t s = 0; s < signals.size(); ++s)
    mode.amplitudes.emplace_back(signals[s], std::abs(found.amplitudes[Eigen::Index(s)]));
  return mode;
}

/// A window shorter than two periods does not distinguish a frequency from a drift.  @return a note
std::string leave_out_slow(std::vector<DampedOscillation> &found, const Ringing &ringing)
{
  const double     window            = ringing.end - ringing.begin;
  constexpr double periods_of_window = 2.; // fewer leave frequency and decay undecided between modes
  const auto       slow =
      std::remove_if(found.begin(), found.end(),
                     [&](const DampedOscillation &own) { return own.frequency_hz() * window < periods_of_window; });
  if (slow == found.end())
    return "";
  found.erase(slow, found.end());
  return "vibrations below " + rounded(periods_of_window / window) + " Hz are omitted: the window of " +
         rounded(window) + " s after the last contact is shorter than two periods";
}

/// The strongest first, so that each is compared with those that may have made it.
void tell_modes(std::vector<DampedOscillation> found, const std::vector<coupling::Mode> &linearised, Ringing &ringing)
{
  std::sort(found.begin(), found.end(), [](const auto &a, const auto &b) { return a.strength > b.strength; });
  std::vector<DampedOscillation> stronger;
  for (const DampedOscillation &own : found)
  {
    RingingMode mode = ringing_mode(own, ringing.signals);
    mode.combination = combination(own, stronger);
    if (mode.combination.empty())
    {
      pair_up(linearised, mode);
      stronger.push_back(own);
    }
    ringing.modes.push_back(std::move(mode));
  }
  std::sort(ringing.modes.begin(), ringing.modes.end(),
            [](const auto &a, const auto &b) { return a.frequency_hz < b.frequency_hz; });
}

} // namespace

void find_ringing(const Scene &scene, PreparedMachine &prepared, const Eigen::VectorXd &end_state, const RunResult &run,
                  StageResult &result)
{
  const HistoryRows rows(run);
  Ringing          &ringing = result.ringing;
  ringing.begin             = ringing_begin(run, result.stages.back());
  ringing.end               = result.stages.back().end;
  ringing.signals           = scene.stages.ringing;
  for (const std::string &signal : ringing.signals)
    ringing.units.push_back(rows.unit(rows.column(signal)));
  const Eigen::MatrixXd samples       = samples_of(rows, coupling::output_step(scene.run.options), ringing);
  constexpr long        least_samples = 40; // twice the poles of ten modes
  if (samples.rows() < least_samples)
  {
    result.ringing.note = "too few history rows after the last contact at " + rounded(ringing.begin) +
                          " s: " + std::to_string(samples.rows()) + " rows, " + std::to_string(least_samples) +
                          " needed; increase run.end or reduce output.step";
    return;
  }
  coupling::PencilFit fit = coupling::matrix_pencil(samples, ringing.step, scene.stages.modes);
  ringing.residual        = fit.residual;
  result.ringing.note     = leave_out_slow(fit.oscillations, ringing);
  std::vector<coupling::Mode> linearised;
  try
  {
    linearised = modes_at_rest(prepared, end_state, scene.run.options.begin);
  }
  catch (const std::exception &none)
  {
    result.ringing.note = std::string("no linearised modes for comparison: ") + none.what();
  }
  tell_modes(fit.oscillations, linearised, ringing);
}

} // namespace gestell::apps
