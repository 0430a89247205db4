#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace gestell::apps
{

/// A force of finite duration, relative to the period T of a mode.
struct LoadOnMode
{
  int         mode         = -1;                   ///< from 0, in the order of the scene's modes; -1: none of them
  double      frequency_hz = 0.;                   ///< undamped, 1/T
  double      duration = 0., rise = 0., fall = 0.; ///< each over T
  double      fall_factor = 0.;                    ///< residual amplitude relative to that of a sudden fall
  double      energy      = std::numeric_limits<double>::quiet_NaN(); ///< [J] in the mode after the fall
  std::string strain{};                                               ///< elements that contain its strain energy
};

template <class Visitor>
void describe(Visitor &v, const LoadOnMode &x)
{
  v("mode", x.mode < 0 ? std::nullopt : std::optional(x.mode + 1), "",
    "number in the table of modes; null: none has its shape");
  v("frequency_hz", x.frequency_hz, "Hz", "undamped, 1/T");
  v("duration_over_period", x.duration, "1", "duration of the load over T");
  v("rise_over_period", x.rise, "1", "its rise over T");
  v("fall_over_period", x.fall, "1", "its fall over T");
  v("fall_factor", x.fall_factor, "1", "amplitude that the fall leaves, over that of a sudden one");
  v("energy", x.energy, "J", "energy that the fall leaves in the mode; null: not known");
  v("strain_energy_in", x.strain, "", "part with most of its strain energy");
}

/// A technological force from its first contact to its fall.
struct LoadDuration
{
  std::string signal, element, unit;
  double      begin = 0., end = 0.;              ///< [s] interval in which it is above 1 % of its peak
  double      peak = 0., t_peak = 0.;            ///< with its sign
  double      rise = 0., t_fall = 0., fall = 0.; ///< [s] time to 90 % of the peak; start and duration of the fall
  double      row_step = 0.;                     ///< [s] largest interval between the output rows used
  std::vector<LoadOnMode> modes;                 ///< of the machine in its configuration where the force begins to fall
  double                  t_modes = 0.;          ///< [s] time of this configuration
  std::string             place, unknown;        ///< "crank 160.2 deg"; why there are no modes, empty if there are

  /// Whether output rows are too far apart: fewer than ten while the force acts, or fewer than four during its fall.
  bool is_coarse() const { return 10. * row_step > t_fall - begin || 4. * row_step > fall; }
};

template <class Visitor>
void describe(Visitor &v, const LoadDuration &x)
{
  v("signal", x.signal, "", "of the force");
  v("element", x.element, "", "that exerts it");
  v("begin", x.begin, "s", "first instant above 1 % of the peak");
  v("end", x.end, "s", "last instant above 1 % of the peak");
  v("peak", x.peak, x.unit, "largest force, with its sign");
  v("unit", x.unit, "", "of `peak`");
  v("t_peak", x.t_peak, "s", "its instant");
  v("rise", x.rise, "s", "from the begin to 90 % of the peak");
  v("t_fall", x.t_fall, "s", "where the force begins to fall below 90 % of the peak");
  v("fall", x.fall, "s", "from there to its end");
  v("row_step", x.row_step, "s", "largest distance of the rows these times are read from");
  v("is_coarse", x.is_coarse(), "", "rows are too far apart for these times");
  v("t_modes", x.unknown.empty() ? std::optional(x.t_modes) : std::nullopt, "s",
    "instant of the modes; null: no state was kept there");
  v("place", x.place, "", "of the machine at that instant");
  v("no_modes_because", x.unknown, "", "why there are no modes; empty: there are");
  v("modes", x.modes, "", "modes of the machine as it stands there");
}

/// A signal of an object at one of its located events.
struct EventValue
{
  double      t = 0.; ///< [s]
  std::string object, event, signal, unit;
  double      before = 0., after = 0.;
  double      rate = std::numeric_limits<double>::quiet_NaN(); ///< of a displacement, just before the event [unit/s]
  double impulse   = std::numeric_limits<double>::quiet_NaN(); ///< of a force, until the object's next event [unit s]
};

template <class Visitor>
void describe(Visitor &v, const EventValue &x)
{
  v("t", x.t, "s", "instant");
  v("object", x.object, "", "whose event it is");
  v("event", x.event, "", "kind of the event");
  v("signal", x.signal, "", "of the object");
  v("unit", x.unit, "", "of `before` and `behind`");
  v("before", x.before, "", "value just before the event");
  v("behind", x.after, "", "value just behind it");
  v("rate", x.rate, "", "`unit`/s, of a displacement, just before; null: of a force, or not known");
  v("impulse", x.impulse, "",
    "`unit` s, of a force until the next event of its object; null: of a displacement, or rows are too far apart");
}

/// The extreme of a force, and the vibration around it.
struct ExtremeSwing
{
  std::string signal, unit;
  bool        largest = true;
  double      t = 0., value = 0.;
  double      swing_hz = std::numeric_limits<double>::quiet_NaN(); ///< 0.5 / time between its turning points
  int         mode     = -1; ///< from 0, in the order of the scene's modes; -1: none of them
  double      mode_hz = std::numeric_limits<double>::quiet_NaN(), share = mode_hz, sum = mode_hz;
  std::string strain{}; ///< element with most of its strain energy
};

template <class Visitor>
void describe(Visitor &v, const ExtremeSwing &x)
{
  v("signal", x.signal, "", "of the force");
  v("extreme", x.largest ? "max" : "min", "", "`max` or `min`");
  v("t", x.t, "s", "its instant");
  v("value", x.value, "", "with its sign");
  v("unit", x.unit, "", "of `value`");
  v("swing_hz", x.swing_hz, "Hz",
    "1/(2 time) between the turning points of the swing; null: it does not turn there, or rows are too far apart");
  v("mode", x.mode < 0 ? std::nullopt : std::optional(x.mode + 1), "",
    "number, in the table of modes, of the mode that makes most of the swing; null: none has its shape");
  v("mode_hz", x.mode_hz, "Hz",
    "its frequency where the swing turns; null: no states were kept, or positions do not tell the force");
  v("share", x.share, "1", "what it makes of the force's change in the swing");
  v("sum_of_shares", x.sum, "1", "over all modes; far from 1: positions alone do not tell the force");
  v("strain_energy_in", x.strain, "", "part with most strain energy of the mode");
}

/// An element with clearance: its describing function compared with the run.
struct PlayEstimate
{
  std::string element, signal, unit;     ///< of amplitude and mean: "m" or "rad"
  double      begin = 0., end = 0.;      ///< [s] of the oscillation examined
  double      amplitude = 0., mean = 0.; ///< [m] or [rad] of the element's measure
  double      stiffness_share = 0.;      ///< equivalent stiffness divided by engaged stiffness
  double      frequency_hz = 0., seen_hz = 0., closed_hz = 0.;
  int         mode = -1;
  std::string limits; ///< why it is not valid; empty: it is
};

template <class Visitor>
void describe(Visitor &v, const PlayEstimate &x)
{
  v("element", x.element, "", "with play");
  v("signal", x.signal, "", "of its measure");
  v("unit", x.unit, "", "of `amplitude` and `mean`");
  v("begin", x.begin, "s", "start of the oscillation");
  v("end", x.end, "s", "its end");
  v("amplitude", x.amplitude, "", "of the measure");
  v("mean", x.mean, "", "of the measure");
  v("stiffness_share", x.stiffness_share, "1", "equivalent over engaged stiffness");
  v("mode", x.mode + 1, "", "number of the mode");
  v("frequency_hz", x.frequency_hz, "Hz", "by the describing function");
  v("seen_hz", x.seen_hz, "Hz", "in the run");
  v("closed_hz", x.closed_hz, "Hz", "with the play closed");
  v("limits", x.limits, "", "where the estimate does not hold; empty: it does");
}

/// Facts about a run with events.
struct RunStory
{
  std::vector<LoadDuration> loads;
  std::vector<EventValue>   events; ///< in the order of time
  std::vector<ExtremeSwing> extremes;
  std::vector<PlayEstimate> plays;
};

template <class Visitor>
void describe(Visitor &v, const RunStory &x)
{
  v("loads", x.loads, "", "forces that act for a time");
  v("events", x.events, "", "signals at located events of their objects");
  v("extremes", x.extremes, "", "swings about the extremes of forces and torques");
  v("plays", x.plays, "", "oscillations of elements with play");
}

} // namespace gestell::apps
