#include "apps/session/story/run_facts.h"

#include "apps/session/history_rows.h"
#include "apps/session/joint_opening.h"
#include "apps/session/story/load_duration.h"
#include "apps/session/story/play_estimate.h"
#include "apps/session/story/swing_shares.h"
#include "apps/session/story/turning_points.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{

namespace
{

constexpr double one_instant = 1e-9; ///< of the run: its rounding

bool is_force(const coupling::Signal &signal)
{
  return signal.unit == "N" || signal.unit == "N m";
}

bool is_displacement(const coupling::Signal &signal)
{
  return signal.unit == "m" || signal.unit == "rad";
}

std::size_t row_before(const HistoryRows &rows, double t)
{
  std::size_t low = 0, high = rows.size();
  while (high - low > 1)
    (rows.t((low + high) / 2) <= t ? low : high) = (low + high) / 2;
  return low;
}

/// Whether rows between two instants are that share of their distance apart, or closer.
bool fine_between(const HistoryRows &rows, double begin, double end, double share)
{
  double widest = 0.;
  for (std::size_t i = row_before(rows, begin) + 1; i < rows.size() && rows.t(i - 1) < end; ++i)
    widest = std::max(widest, rows.t(i) - rows.t(i - 1));
  return widest <= share * (end - begin) * (1. + one_instant);
}

/// The located events of a run, with the motion at each.
class EventsOfRun
{
public:
  explicit EventsOfRun(const coupling::RunResult &run) : run_(run), rows_(run) {}

  /// Null if the motion there is unknown.
  const coupling::EventValues *at(std::size_t e) const
  {
    if (e >= run_.event_values.size() || rows_.size() < 2)
      return nullptr;
    const coupling::EventValues &at     = run_.event_values[e];
    const double                 length = rows_.t(rows_.size() - 1) - rows_.t(0);
    const bool                   here   = std::abs(at.t - run_.events[e].t) <= one_instant * length;
    return here && !at.before.empty() && !at.after.empty() ? &at : nullptr;
  }

  /// Integral of the force s from an event to the next one of its object; NaN: rows are too far apart.
  double impulse(std::size_t e, std::size_t s) const
  {
    const std::size_t next = next_of(e);
    const auto       *from = at(e), *to = at(next);
    constexpr double  coarsest = 0.1; // distance of rows, of the time they are summed over: trapezoids within 1 %
    if (!from || !to || !fine_between(rows_, from->t, to->t, coarsest))
      return std::nan("");
    double     sum = 0., t = from->t, F = from->after[s];
    const auto add = [&](double t_next, double F_next)
    {
      sum += 0.5 * (F + F_next) * (t_next - t);
      t = t_next;
      F = F_next;
    };
    for (std::size_t i = row_before(rows_, t) + 1; i < rows_.size() && rows_.t(i) < to->t; ++i)
      add(rows_.t(i), rows_.at(i, s + 1));
    add(to->t, to->before[s]);
    return sum;
  }

private:
  std::size_t next_of(std::size_t e) const
  {
    const std::string &object = run_.events[e].name;
    do
      ++e;
    while (e < run_.events.size() && run_.events[e].name != object);
    return e;
  }

  const coupling::RunResult &run_;
  HistoryRows                rows_;
};

/// The states kept around an extreme; null: none.
const std::vector<coupling::KeptState> *states_about(const std::vector<coupling::Signal> &signals,
                                                     const coupling::RunResult &run, std::size_t s, bool largest)
{
  const auto &around = run.states.around;
  const auto  wanted = swing_extremes(signals, 1); // all of them; the stored ones come first
  for (std::size_t i = 0; i < std::min(wanted.size(), around.size()); ++i)
    if (wanted[i].signal == int(s) && wanted[i].largest == largest)
      return &around[i];
  return nullptr;
}

/// Writes the mode with the largest contribution to a half-cycle into `swing`.
void add_mode(ExtremeSwing &swing, const coupling::Signal &signal, const coupling::Machine &machine, double change,
              const std::vector<const coupling::KeptState *> &path, const LocalModes &there)
{
  const Eigen::VectorXd shares = swing_changes(signal, machine, there.modes, path) / change;
  Eigen::Index          most   = 0;
  const double          share  = shares.maxCoeff(&most);
  swing.sum                    = shares.sum();
  if (!(share > 0.))
    return; // positions do not determine the force
  swing.share   = share;
  swing.mode    = there.numbers[std::size_t(most)];
  swing.mode_hz = there.modes[std::size_t(most)].frequency_hz;
  swing.strain  = there.strain(std::size_t(most));
}

} // namespace

std::vector<EventValue> event_log(const std::vector<coupling::Signal> &signals, const coupling::Machine &machine,
                                  const Result &result)
{
  const auto             &elements = machine.model().elements();
  const auto             &events   = result.run->events;
  const EventsOfRun       known(*result.run);
  std::vector<EventValue> log;
  for (std::size_t e = 0; e < events.size(); ++e)
    for (std::size_t s = 0; s < signals.size() && known.at(e); ++s)
    {
      const coupling::Signal &signal = signals[s];
      if (signal.element < 0 || elements[std::size_t(signal.element)].name != events[e].name ||
          !(is_force(signal) || is_displacement(signal)))
        continue;
      const coupling::EventValues &at = *known.at(e);
      EventValue                   value{events[e].t, events[e].name, events[e].kind, signal.name,
                       signal.unit, at.before[s],   at.after[s]};
      (is_force(signal) ? value.impulse : value.rate) = is_force(signal) ? known.impulse(e, s) : at.rate[s];
      log.push_back(value);
    }
  return log;
}

std::vector<ExtremeSwing> extreme_swings(const std::vector<coupling::Signal> &signals, const coupling::Machine &machine,
                                         const Result &result, ModesOfRun &modes)
{
  const coupling::RunResult &run = *result.run;
  const HistoryRows          rows(run);
  std::vector<ExtremeSwing>  found;
  std::vector<double>        time, y(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    time.push_back(rows.t(i));
  for (std::size_t s = 0; s < signals.size() && rows.size() > 2; ++s)
  {
    if (!is_force(signals[s]))
      continue;
    const coupling::SignalSummary &own = run.signals[s];
    for (std::size_t i = 0; i < rows.size(); ++i)
      y[i] = rows.at(i, s + 1);
    for (const bool largest : {true, false})
    {
      ExtremeSwing extreme{signals[s].name, signals[s].unit, largest, largest ? own.t_max : own.t_min,
                           largest ? own.max : own.min};
      if (!(extreme.t > time.front() && extreme.t < time.back()))
        continue;
      found.push_back(extreme);
      const Swing  swing = swing_at(time, y, extreme.t);
      const auto   value = [&](double t) { return y[row_before(rows, t)]; };
      const double size  = std::max(std::abs(own.min), std::abs(own.max));
      // distance of rows relative to a half-cycle: its ends are then accurate to 0.3 % of the amplitude
      constexpr double of_swing = 0.05;
      // of the largest amount: a turning point so far from an extreme is another one
      constexpr double beside_it = 0.1;
      if (!(swing.half > 0.) || std::abs(value(swing.turn) - extreme.value) > beside_it * size ||
          !fine_between(rows, extreme.t - 0.5 * swing.half, extreme.t + 0.5 * swing.half, of_swing))
        continue;
      found.back().swing_hz = 0.5 / swing.half;
      const auto *states    = states_about(signals, run, s, largest);
      if (!states || result.coupled_modes.empty())
        continue;
      const auto path = states_of_swing(*states, swing.nearby, swing.turn, of_swing * swing.half);
      if (path.empty() || path.back()->q.size() != machine.size())
        continue;
      if (const LocalModes &there = modes.at(*path.back()); !there.modes.empty())
        add_mode(found.back(), signals[s], machine, value(swing.turn) - value(swing.nearby), path, there);
    }
  }
  return found;
}

void add_story(Session &session, Result &result)
{
  const Scene       &scene   = session.scene();
  coupling::Machine &machine = session.machine().small();
  const auto signals = with_normal_forces(scene, machine, scene_signals(scene, machine)); // of its own coordinates
  if (!result.run || result.run->events.empty() || result.run->signals.size() != signals.size())
    return;
  for (auto &states : result.run->states.around)
    for (coupling::KeptState &state : states)
      if (session.machine().companion)
      {
        state.q = session.machine().project(state.q);
        state.v = session.machine().project(state.v);
      }
  RunStory   story;
  ModesOfRun modes(scene, machine, result);
  machine.events().follow_history(false); // forces by the motion, whatever branch the run ended in
  story.loads    = load_durations(signals, machine, result, modes);
  story.events   = event_log(signals, machine, result);
  story.extremes = extreme_swings(signals, machine, result, modes);
  story.plays    = play_estimates(signals, machine, modes_configuration(scene, machine), result);
  result.story   = std::move(story);
  result.run->states.around.clear();
}

} // namespace gestell::apps
