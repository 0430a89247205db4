#pragma once

#include <limits>
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

/// What happened at an instant.
struct StorySentence
{
  double      t = 0.; ///< [s]
  std::string text;
  bool        stands_out = false; ///< the largest or smallest value of the run
};

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

/// What a run tells beside its numbers.
struct RunStory
{
  std::vector<LoadDuration>  loads;
  std::vector<StorySentence> sentences; ///< in the order of time
  std::vector<PlayEstimate>  plays;
};

} // namespace gestell::apps
