#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace gestell::apps
{

/// A force that acts for a time, beside the period T of a mode.
struct LoadOnMode
{
  int         mode         = -1; ///< from 0 on, as the modes of the scene are numbered; -1: none of them
  double      frequency_hz = 0.; ///< undamped, 1/T
  double      duration = 0., rise = 0., fall = 0.; ///< each over T
  double      fall_factor = 0.;                    ///< amplitude the fall leaves, over that of a sudden one
  double      energy      = std::numeric_limits<double>::quiet_NaN(); ///< [J] that the fall leaves in the mode
  std::string strain{};                                               ///< where its strain energy lies
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
}

/// A technological force from its first contact to its fall.
struct LoadDuration
{
  std::string signal, element, unit;
  double      begin = 0., end = 0.;              ///< [s] between them it is above a hundredth of its peak
  double      peak = 0., t_peak = 0.;            ///< with its sign
  double      rise = 0., t_fall = 0., fall = 0.; ///< [s] to 0.9 of the peak; from there down, see load_duration()
  double      row_step = 0.;                     ///< [s] largest distance of the rows these are read from
  std::vector<LoadOnMode> modes;                 ///< of the machine as it stands where the force begins to fall
  double                  t_modes = 0.;          ///< [s] when it stands there
  std::string             place, unknown;        ///< "crank 160.2 deg"; why there are no modes, empty: there are

  /// Whether rows are too far apart: fewer than ten over the time it acts, or fewer than four over its fall.
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

/// What happened at an instant.
struct StorySentence
{
  double      t = 0.; ///< [s]
  std::string text;
  bool        stands_out = false; ///< the largest or smallest value of the run
};

template <class Visitor>
void describe(Visitor &v, const StorySentence &x)
{
  v("t", x.t, "s", "instant");
  v("text", x.text, "", "what happened");
}

/// An element with play by its describing function, beside what the run shows.
struct PlayEstimate
{
  std::string element, signal, unit;     ///< of amplitude and mean: "m" or "rad"
  double      begin = 0., end = 0.;      ///< [s] of the oscillation that is looked at
  double      amplitude = 0., mean = 0.; ///< [m] or [rad] of the element's measure
  double      stiffness_share = 0.;      ///< equivalent over engaged stiffness
  double      frequency_hz = 0., seen_hz = 0., closed_hz = 0.;
  int         mode = -1;
  std::string limits; ///< where it does not hold; empty: it does
};

template <class Visitor>
void describe(Visitor &v, const PlayEstimate &x)
{
  v("element", x.element, "", "with play");
  v("signal", x.signal, "", "of its measure");
  v("unit", x.unit, "", "of `amplitude` and `mean`");
  v("begin", x.begin, "s", "begin of the oscillation");
  v("end", x.end, "s", "its end");
  v("amplitude", x.amplitude, x.unit, "of the measure");
  v("mean", x.mean, x.unit, "of the measure");
  v("stiffness_share", x.stiffness_share, "1", "equivalent over engaged stiffness");
  v("mode", x.mode + 1, "", "number of the mode");
  v("frequency_hz", x.frequency_hz, "Hz", "by the describing function");
  v("seen_hz", x.seen_hz, "Hz", "in the run");
  v("closed_hz", x.closed_hz, "Hz", "with the play closed");
  v("limits", x.limits, "", "where the estimate does not hold; empty: it does");
}

/// What a run tells beside its numbers.
struct RunStory
{
  std::vector<LoadDuration>  loads;
  std::vector<StorySentence> sentences; ///< in the order of time
  std::vector<PlayEstimate>  plays;
};

template <class Visitor>
void describe(Visitor &v, const RunStory &x)
{
  v("loads", x.loads, "", "forces that act for a time");
  v("sentences", x.sentences, "", "what happened");
  v("plays", x.plays, "", "oscillations of elements with play");
}

} // namespace gestell::apps
