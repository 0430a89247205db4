#include "apps/session/story/run_story.h"

#include "apps/session/joint_opening.h"
#include "apps/session/stages/history_rows.h"
#include "apps/session/story/load_duration.h"
#include "apps/session/story/play_estimate.h"
#include "apps/session/story/swing_shares.h"
#include "apps/session/story/turning_points.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace gestell::apps
{

namespace
{

constexpr int         told_twice     = 2;
constexpr double      rounding       = 1e-6; ///< of the largest value
constexpr std::size_t most_sentences = 60, fewest_events = 20;
constexpr double      one_instant = 1e-9; ///< of the run
constexpr double      coarsest    = 0.1;  ///< distance of rows, of the time over which they are summed up
constexpr double      of_swing    = 0.05; ///< distance of rows, of half a swing: its ends are rows
constexpr double      nothing     = 1e-6; ///< of the largest rate at events, or force
constexpr double      jumps       = 1e-3; ///< of the largest force
constexpr double      near_mode   = 0.25; ///< relative difference of frequencies up to which a swing is a mode's own
constexpr double      carries     = 0.5;  ///< share of a swing that a mode makes to carry it
constexpr double      beside_it = 0.1; ///< of the largest amount: a turning point so far from an extreme is another one
constexpr double      overdone  = 1.2; ///< share from which on other modes work against it
constexpr double      missed    = 0.2; ///< of a swing, by the sum over all modes
constexpr double      no_momentum = 1e-3; ///< of the largest force times the time it acts

/// In the unit in which a signal reads well at its largest.
std::string shown(double x, const coupling::SignalSummary &signal)
{
  const DisplayUnit own = display_unit(signal.unit, std::max(std::abs(signal.min), std::abs(signal.max)));
  return short_text(x * own.factor, 4) + ' ' + own.unit;
}

std::string milliseconds(double t)
{
  return short_text(1e3 * t, 3) + " ms";
}

std::string spoken(std::string kind)
{
  std::replace(kind.begin(), kind.end(), '_', ' ');
  return kind;
}

class Story
{
public:
  Story(const std::vector<coupling::Signal> &signals, const coupling::Machine &machine, const Result &result,
        ModesOfRun &modes)
      : signals_(signals), machine_(machine), result_(result), modes_(modes), rows_(*result.run)
  {
  }

  std::vector<StorySentence> told()
  {
    add_events();
    add_extremes();
    std::stable_sort(sentences_.begin(), sentences_.end(), [](const auto &a, const auto &b) { return a.t < b.t; });
    shorten();
    return std::move(sentences_);
  }

private:
  void                         add_events();
  std::string                  event_text(std::size_t e) const;
  std::string                  momentum_text(std::size_t e, std::size_t s) const;
  std::string                  value_text(const coupling::EventValues &at, std::size_t s) const;
  double                       rate_of(const coupling::EventValues &at, std::size_t s) const;
  double                       size_of(std::size_t s) const; ///< the largest amount of a signal
  bool                         fine_between(double begin, double end, double share) const;
  void                         shorten();
  const coupling::EventValues *values_at(std::size_t e) const;
  std::size_t next_of(std::size_t e) const; ///< the next event of its object; the number of events: none
  void        add_extremes();
  void        add_extreme(std::size_t s, bool largest);
  std::string of_window() const;
  std::string carried_by(std::size_t s, double t, bool largest) const;
  std::string makers_of(std::size_t s, const Swing &swing, bool largest) const;
  std::string mode_of(std::size_t s, const Swing &swing, const std::vector<const coupling::KeptState *> &path,
                      const ModesThere &there) const;
  std::string followed(std::size_t s, const Swing &swing) const;
  bool        is_tools(std::size_t s) const;
  const std::vector<coupling::KeptState> *states_about(std::size_t s, bool largest) const;
  std::size_t                             row_before(double t) const;
  bool                                    belongs_to(std::size_t s, const std::string &object) const;

  const std::vector<coupling::Signal> &signals_;
  const coupling::Machine             &machine_;
  const Result                        &result_;
  ModesOfRun                          &modes_;
  HistoryRows                          rows_;
  std::vector<StorySentence>           sentences_;
};

std::size_t Story::row_before(double t) const
{
  std::size_t low = 0, high = rows_.size();
  while (high - low > 1)
    (rows_.t((low + high) / 2) <= t ? low : high) = (low + high) / 2;
  return low;
}

bool Story::belongs_to(std::size_t s, const std::string &object) const
{
  const int element = signals_[s].element;
  return element >= 0 && machine_.model().elements()[std::size_t(element)].name == object;
}

std::size_t Story::next_of(std::size_t e) const
{
  const auto &events = result_.run->events;
  for (std::size_t k = e + 1; k < events.size(); ++k)
    if (events[k].name == events[e].name)
      return k;
  return events.size();
}

/// Both motions of a located event; null where they are not known.
const coupling::EventValues *Story::values_at(std::size_t e) const
{
  const coupling::RunResult &run = *result_.run;
  if (e >= run.event_values.size() || rows_.size() < 2)
    return nullptr;
  const coupling::EventValues &at     = run.event_values[e];
  const double                 length = rows_.t(rows_.size() - 1) - rows_.t(0);
  const bool                   here   = std::abs(at.t - run.events[e].t) <= one_instant * length;
  return here && !at.before.empty() && !at.behind.empty() ? &at : nullptr;
}

/// Whether rows between two instants are that share of their distance apart, or closer.
bool Story::fine_between(double begin, double end, double share) const
{
  double widest = 0.;
  for (std::size_t i = row_before(begin) + 1; i < rows_.size() && rows_.t(i - 1) < end; ++i)
    widest = std::max(widest, rows_.t(i) - rows_.t(i - 1));
  return widest <= share * (end - begin) * (1. + one_instant);
}

/// What the force passes on from an event to the next one of its object: trapezoids from the value behind the one over
/// the rows to the value before the other.
std::string Story::momentum_text(std::size_t e, std::size_t s) const
{
  const auto       &events = result_.run->events;
  const std::size_t next   = next_of(e);
  const auto       *from = values_at(e), *to = values_at(next);
  if (!from || !to || !fine_between(events[e].t, events[next].t, coarsest))
    return "";
  double     sum = 0., peak = 0., t = events[e].t, F = from->behind[s];
  const auto add = [&](double t_next, double F_next)
  {
    sum += 0.5 * (F + F_next) * (t_next - t);
    peak = std::abs(F_next) > std::abs(peak) ? F_next : peak;
    t    = t_next;
    F    = F_next;
  };
  for (std::size_t i = row_before(t) + 1; i < rows_.size() && rows_.t(i) < events[next].t; ++i)
    add(rows_.t(i), rows_.at(i, s + 1));
  add(events[next].t, to->before[s]);
  const double size = size_of(s);
  if (std::abs(peak) < 0.1 * size || std::abs(sum) < no_momentum * size * (events[next].t - events[e].t))
    return "";
  return "until its next event " + milliseconds(events[next].t - events[e].t) + " later it passes on " +
         short_text(sum, 4) + " " + signals_[s].unit + " s and reaches " + shown(peak, result_.run->signals[s]);
}

double Story::size_of(std::size_t s) const
{
  const coupling::SignalSummary &whole = result_.run->signals[s];
  return std::max(std::abs(whole.min), std::abs(whole.max));
}

/// Before an event; 0 where it is nothing beside the rates at others.
double Story::rate_of(const coupling::EventValues &at, std::size_t s) const
{
  double most = 0.;
  for (const coupling::EventValues &other : result_.run->event_values)
    if (!other.rate.empty() && std::isfinite(other.rate[s]))
      most = std::max(most, std::abs(other.rate[s]));
  return std::abs(at.rate[s]) > nothing * most ? at.rate[s] : 0.;
}

/// Before an event and, where it jumps, behind it.
std::string Story::value_text(const coupling::EventValues &at, std::size_t s) const
{
  const coupling::SignalSummary &own    = result_.run->signals[s];
  const auto                     seen   = [&](double F) { return std::abs(F) > nothing * size_of(s) ? F : 0.; };
  const double                   before = seen(at.before[s]), behind = seen(at.behind[s]);
  return std::abs(behind - before) <= jumps * size_of(s)
             ? " is " + shown(before, own)
             : " jumps from " + shown(before, own) + " to " + shown(behind, own);
}

std::string Story::event_text(std::size_t e) const
{
  const coupling::Event       &event = result_.run->events[e];
  std::string                  text  = event.name + ": " + spoken(event.kind);
  const coupling::EventValues *at    = values_at(e);
  for (std::size_t s = 0; s < signals_.size() && at; ++s)
  {
    const std::string &unit = signals_[s].unit;
    if (!belongs_to(s, event.name))
      continue;
    if ((unit == "m" || unit == "rad") && std::isfinite(at->rate[s]))
      text += ", " + signals_[s].name + " changes by " + short_text(rate_of(*at, s), 3) + " " + unit + "/s";
    if (unit != "N" && unit != "N m")
      continue;
    text += ", " + signals_[s].name + value_text(*at, s);
    if (const std::string momentum = momentum_text(e, s); !momentum.empty())
      text += "; " + momentum;
  }
  return text;
}

/// Extremes stay; of the events the first ones, and how many were left out.
void Story::shorten()
{
  std::size_t events = 0, left_out = 0;
  const auto  extremes =
      std::size_t(std::count_if(sentences_.begin(), sentences_.end(), [](const auto &one) { return one.stands_out; }));
  const std::size_t          most = std::max(fewest_events, most_sentences - std::min(most_sentences, extremes));
  std::vector<StorySentence> kept;
  for (StorySentence &sentence : sentences_)
    if (sentence.stands_out || ++events <= most)
      kept.push_back(std::move(sentence));
    else if (++left_out == 1)
      kept.push_back({sentence.t, "", false});
  for (StorySentence &sentence : kept)
    if (sentence.text.empty())
      sentence.text = "from here on " + std::to_string(left_out) + (left_out == 1 ? " sentence" : " sentences") +
                      " on events left out: summary.json has all events";
  sentences_ = std::move(kept);
}

void Story::add_events()
{
  const auto                                        &events = result_.run->events;
  std::map<std::pair<std::string, std::string>, int> told, all;
  for (const coupling::Event &event : events)
    ++all[{event.name, event.kind}];
  for (std::size_t e = 0; e < events.size(); ++e)
  {
    const std::pair key{events[e].name, events[e].kind};
    if (++told[key] > told_twice)
      continue;
    std::string text = event_text(e);
    if (const int more = all[key] - told[key]; told[key] == told_twice && more > 0)
      text += "; likewise " + std::to_string(more) + (more == 1 ? " more time" : " more times");
    sentences_.push_back({events[e].t, text, false});
  }
}

/// Whether it is the force of a tool.
bool Story::is_tools(std::size_t s) const
{
  const int element = signals_[s].element;
  return element >= 0 && is_tool(*machine_.model().elements()[std::size_t(element)].element);
}

/// The vibration about an extreme, and what makes it.
std::string Story::carried_by(std::size_t s, double t, bool largest) const
{
  const double x = largest ? result_.run->signals[s].max : result_.run->signals[s].min;
  if (is_tools(s))
    return ", a force of its law, no vibration";
  std::vector<double> time, y;
  for (std::size_t i = 0; i < rows_.size(); ++i)
  {
    time.push_back(rows_.t(i));
    y.push_back(rows_.at(i, s + 1));
  }
  const Swing swing = swing_at(time, y, t);
  if (!(swing.half > 0.) || std::abs(rows_.at(row_before(swing.turn), s + 1) - x) > beside_it * size_of(s))
    return ", on which it does not turn back";
  if (!fine_between(t - 0.5 * swing.half, t + 0.5 * swing.half, of_swing))
    return ", the rows too far apart to tell a swing";
  return ", half a swing of " + milliseconds(swing.half) + " (" + short_text(0.5 / swing.half, 3) + " Hz)" +
         makers_of(s, swing, largest);
}

/// The force of a tool that makes most of a swing and of its extreme; empty: none.
std::string Story::followed(std::size_t s, const Swing &swing) const
{
  const std::size_t turn = row_before(swing.turn), beside = row_before(swing.beside);
  const auto        alike = [](double tool, double F) { return tool / F >= 0.5 && tool / F <= 2.; };
  for (std::size_t k = 0; k < signals_.size(); ++k)
  {
    if (k == s || signals_[k].unit != signals_[s].unit || !is_tools(k))
      continue;
    const double F = rows_.at(turn, s + 1), F_0 = rows_.at(beside, s + 1), tool = rows_.at(turn, k + 1),
                 tool_0 = rows_.at(beside, k + 1), sign = tool * F < 0. ? -1. : 1.;
    if (alike(sign * tool, F) && alike(sign * (tool - tool_0), F - F_0))
      return signals_[k].name;
  }
  return "";
}

/// The states kept around an extreme; null: none.
const std::vector<coupling::KeptState> *Story::states_about(std::size_t s, bool largest) const
{
  const auto &around = result_.run->states.around;
  const auto  wanted = swing_extremes(signals_, 1); // all of them; those kept are the first ones
  for (std::size_t i = 0; i < std::min(wanted.size(), around.size()); ++i)
    if (wanted[i].signal == int(s) && wanted[i].largest == largest)
      return &around[i];
  return nullptr;
}

/// What makes half a swing, and whether it is free vibration of a mode.
std::string Story::makers_of(std::size_t s, const Swing &swing, bool largest) const
{
  if (const std::string tool = followed(s, swing); !tool.empty())
    return ", follows " + tool;
  const auto *states = states_about(s, largest);
  if (!states || result_.coupled_modes.empty())
    return "";
  const auto path = states_of_swing(*states, swing.beside, swing.turn, of_swing * swing.half);
  if (path.empty() || path.back()->q.size() != machine_.size())
    return ", longer than states were kept for";
  const ModesThere &there = modes_.at(*path.back());
  return there.modes.empty() ? "" : mode_of(s, swing, path, there);
}

std::string Story::mode_of(std::size_t s, const Swing &swing, const std::vector<const coupling::KeptState *> &path,
                           const ModesThere &there) const
{
  const double          change = rows_.at(row_before(swing.turn), s + 1) - rows_.at(row_before(swing.beside), s + 1);
  const Eigen::VectorXd shares = swing_changes(signals_[s], machine_, there.modes, path) / change;
  if (shares.cwiseAbs().sum() < 1e-3)
    return ", which positions do not tell";
  if (!(std::abs(shares.sum() - 1.) <= missed))
    return "";
  Eigen::Index      most  = 0;
  const double      share = shares.maxCoeff(&most), f = there.modes[std::size_t(most)].frequency_hz;
  const std::string strain = there.strain(std::size_t(most));
  if (share < carries || share > overdone)
    return ", which no mode makes alone";
  if (!(std::abs(std::log(f * 2. * swing.half)) < near_mode))
    return ", no free vibration of a mode";
  return ", carried by " + there.name(std::size_t(most)) + ", which makes " + percent(share) + " of its change" +
         (strain.empty() ? "" : " and strains the " + strain);
}

std::string Story::of_window() const
{
  const double from = result_.run->from;
  return from > rows_.t(0) ? " from " + short_text(from, 6) + " s on: " : " of the run: ";
}

void Story::add_extreme(std::size_t s, bool largest)
{
  const coupling::SignalSummary &own = result_.run->signals[s];
  const double                   x = largest ? own.max : own.min, t = largest ? own.t_max : own.t_min;
  const bool                     inside = rows_.size() > 2 && t > rows_.t(0) && t < rows_.t(rows_.size() - 1);
  const double                   size   = std::max(std::abs(own.min), std::abs(own.max));
  if (inside && std::abs(x) > rounding * size)
    sentences_.push_back({t,
                          own.name + " is " + (largest ? "largest" : "smallest") + of_window() + shown(x, own) +
                              carried_by(s, t, largest),
                          true});
}

void Story::add_extremes()
{
  for (std::size_t s = 0; s < signals_.size(); ++s)
    if (const std::string &unit = signals_[s].unit; unit == "N" || unit == "N m")
    {
      add_extreme(s, true);
      add_extreme(s, false);
    }
}

} // namespace

std::vector<StorySentence> story_sentences(const std::vector<coupling::Signal> &signals,
                                           const coupling::Machine &machine, const Result &result, ModesOfRun &modes)
{
  return Story(signals, machine, result, modes).told();
}

void add_story(Session &session, Result &result)
{
  const Scene       &scene   = session.scene();
  coupling::Machine &machine = session.machine().small();
  const auto         signals =
      with_normal_forces(scene, session.machine().machine, scene_signals(scene, session.machine().machine));
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
  story.loads     = load_durations(signals, machine, result, modes);
  story.sentences = story_sentences(signals, machine, result, modes);
  story.plays     = play_estimates(signals, machine, modes_configuration(scene, machine), result);
  result.story    = std::move(story);
  result.run->states.around.clear();
}

} // namespace gestell::apps
