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
    "number in the table of modes; null: none has this shape");
  v("frequency_hz", x.frequency_hz, "Hz", "undamped, 1/T");
  v("duration_over_period", x.duration, "1", "duration of the load over T");
  v("rise_over_period", x.rise, "1", "rise time over T");
  v("fall_over_period", x.fall, "1", "fall time over T");
  v("fall_factor", x.fall_factor, "1",
    "residual vibration ratio: amplitude after the fall, relative to that after a sudden fall");
  v("energy", x.energy, "J", "energy of the mode after the fall; null: unknown");
  v("strain_energy_in", x.strain, "", "part with the largest share of strain energy");
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
  v("element", x.element, "", "element that exerts the force");
  v("begin", x.begin, "s", "first instant above 1 % of the peak");
  v("end", x.end, "s", "last instant above 1 % of the peak");
  v("peak", x.peak, x.unit, "largest force, with sign");
  v("unit", x.unit, "", "of `peak`");
  v("t_peak", x.t_peak, "s", "its time");
  v("rise", x.rise, "s", "time from the start to 90 % of the peak");
  v("t_fall", x.t_fall, "s", "time at which the force drops below 90 % of the peak");
  v("fall", x.fall, "s", "time from there to the end");
  v("row_step", x.row_step, "s", "largest interval of the rows used for these times");
  v("is_coarse", x.is_coarse(), "", "whether the rows are too far apart for these times");
  v("t_modes", x.unknown.empty() ? std::optional(x.t_modes) : std::nullopt, "s",
    "time of the modes; null: no state was stored there");
  v("place", x.place, "", "configuration of the machine at that time");
  v("no_modes_because", x.unknown, "", "reason why there are no modes; empty: there are some");
  v("modes", x.modes, "", "modes of the machine in this configuration");
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
  v("object", x.object, "", "object of the event");
  v("event", x.event, "", "kind of the event");
  v("signal", x.signal, "", "of the object");
  v("unit", x.unit, "", "of `before` and `behind`");
  v("before", x.before, "", "value just before the event");
  v("behind", x.after, "", "value just after the event");
  v("rate", x.rate, "", "rate of a displacement just before the event, `unit`/s; null for a force, or unknown");
  v("impulse", x.impulse, "",
    "impulse of a force until the next event of its object, `unit` s; null for a displacement, or if rows are too far "
    "apart");
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
  v("t", x.t, "s", "its time");
  v("value", x.value, "", "value, with sign");
  v("unit", x.unit, "", "of `value`");
  v("swing_hz", x.swing_hz, "Hz",
    "frequency 1/(2 x time between turning points); null: no turning points, or rows too far apart");
  v("mode", x.mode < 0 ? std::nullopt : std::optional(x.mode + 1), "",
    "number (in the table of modes) of the mode with the largest share of the oscillation; null: none has this shape");
  v("mode_hz", x.mode_hz, "Hz",
    "frequency of this mode at the turning point; null: no states were stored, or the force does not follow from "
    "positions");
  v("share", x.share, "1", "share of the mode in the change of the force");
  v("sum_of_shares", x.sum, "1",
    "sum of the shares of all modes; far from 1: the force does not follow from positions alone");
  v("strain_energy_in", x.strain, "", "part with the largest strain energy of the mode");
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
  v("element", x.element, "", "element with clearance");
  v("signal", x.signal, "", "signal of its measure");
  v("unit", x.unit, "", "of `amplitude` and `mean`");
  v("begin", x.begin, "s", "start of the oscillation");
  v("end", x.end, "s", "end");
  v("amplitude", x.amplitude, "", "of the measure");
  v("mean", x.mean, "", "of the measure");
  v("stiffness_share", x.stiffness_share, "1", "ratio of equivalent to closed stiffness");
  v("mode", x.mode + 1, "", "number of the mode");
  v("frequency_hz", x.frequency_hz, "Hz", "frequency by the describing function");
  v("seen_hz", x.seen_hz, "Hz", "in the run");
  v("closed_hz", x.closed_hz, "Hz", "frequency with the clearance closed");
  v("limits", x.limits, "", "limits of the estimate; empty: none");
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
  v("loads", x.loads, "", "forces of limited duration");
  v("events", x.events, "", "signals at located events of their objects");
  v("extremes", x.extremes, "", "oscillations around the extremes of forces and torques");
  v("plays", x.plays, "", "oscillations of elements with clearance");
}

} // namespace gestell::apps
