#pragma once

#include <string>
#include <vector>

namespace gestell::apps
{

/// A signal within a stage; nan where no row of the history lies in it.
struct StageExtremes
{
  std::string signal, unit;
  double      min = 0., t_min = 0., max = 0., t_max = 0.;
};

/// A part of a run between two events.
struct Stage
{
  std::string                name;
  double                     begin = 0., end = 0.; ///< [s]
  std::vector<StageExtremes> extremes;             ///< by the rows of the history
};

/// A damped oscillation found in the last stage, and the linearised mode nearest to it in frequency.
struct RingingMode
{
  double              frequency_hz  = 0.; ///< damped
  double              damping_ratio = 0.;
  std::vector<double> amplitudes;         ///< by signal, at the begin of the window
  std::string         combination;        ///< of stronger ones, "3 x 0.4026 Hz"; empty: it is a mode
  int                 linearised    = -1; ///< number of the mode from 0 on; -1: none
  double              linearised_hz = 0., linearised_ratio = 0.; ///< damped frequency
};

/// What rings in the last stage, from where no contact opens or closes any more.
struct Ringing
{
  double                   begin = 0., end = 0., step = 0.; ///< [s] window and samples
  std::vector<std::string> signals, units;
  double                   residual = 0.; ///< of the fit, relative to the signals
  std::vector<RingingMode> modes;         ///< ascending in frequency
};

/// A wheel is off the ground.
struct LiftOff
{
  std::string wheel;
  double      begin = 0., end = 0.; ///< [s]; the end of the run if it does not come down
};

struct StageResult
{
  std::vector<Stage>   stages; ///< as far as the run came
  std::vector<LiftOff> lift_offs;
  Ringing              ringing; ///< without modes: not asked for, or not found
  std::string          reason;  ///< why nothing was found that was asked for; empty: it was
};

} // namespace gestell::apps
