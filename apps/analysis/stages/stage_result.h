#pragma once

#include "apps/output/describe/described.h"
#include "apps/output/report/section.h"
#include "coupling/simulation/run_result.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gestell::apps
{

/// Extremes of a signal within a stage; nan if the stage contains no row of the history.
struct StageExtremes
{
  std::string signal, unit;
  double      min = 0., t_min = 0., max = 0., t_max = 0.;
};

template <class Visitor>
void describe(Visitor &v, const StageExtremes &x)
{
  v("unit", x.unit, "", "of `min` and `max`");
  v("min", x.min, x.unit, "smallest value in history.csv");
  v("t_min", x.t_min, "s", "its time");
  v("max", x.max, x.unit, "largest value");
  v("t_max", x.t_max, "s", "its time");
}

/// A part of a run between two events.
struct Stage
{
  std::string                name;
  double                     begin = 0., end = 0.; ///< [s]
  std::vector<StageExtremes> extremes;             ///< from the rows of the history
};

template <class Visitor>
void describe(Visitor &v, const Stage &x)
{
  v("name", x.name, "", "of the stage");
  v("begin", x.begin, "s", "start of the stage");
  v("end", x.end, "s", "end of the stage");
  v("signals", by_name(x.extremes, &StageExtremes::signal), "", "extremes of each signal within the stage");
}

/// A damped oscillation found in the last stage, and the linearised mode nearest to it in frequency.
struct RingingMode
{
  struct Linearised
  {
    int    mode          = 0; ///< its number, from 1
    double frequency_hz  = 0.;
    double damping_ratio = 0.;
  };

  double                                      frequency_hz  = 0.; ///< damped
  double                                      damping_ratio = 0.;
  std::vector<std::pair<std::string, double>> amplitudes;  ///< by signal, at the start of the window
  std::string                                 combination; ///< of stronger ones, "3 x 0.4026 Hz"; empty: it is a mode
  std::optional<Linearised>                   linearised;  ///< with damping
};

template <class Visitor>
void describe(Visitor &v, const RingingMode::Linearised &x)
{
  v("mode", x.mode, "", "number of the mode");
  v("damped_frequency_hz", x.frequency_hz, "Hz", "damped frequency");
  v("damping_ratio", x.damping_ratio, "1", "damping ratio");
}

template <class Visitor>
void describe(Visitor &v, const RingingMode &x)
{
  v("damped_frequency_hz", x.frequency_hz, "Hz", "damped frequency");
  v("damping_ratio", x.damping_ratio, "1", "damping ratio");
  v("amplitudes", x.amplitudes, "", "amplitude of each signal at the start of the window");
  v("combination", unless_empty(x.combination), "", "combination of stronger vibrations; null: it is a mode");
  v("linearised", x.linearised, "", "nearest mode of the machine linearised at rest; null: none nearby");
}

/// Ringing in the last stage, after the last opening or closing of a contact.
struct Ringing
{
  double                   begin = 0., end = 0., step = 0.; ///< [s] window and samples
  std::vector<std::string> signals, units;
  double                   residual = 0.; ///< of the fit, relative to the signals
  std::vector<RingingMode> modes;         ///< ascending in frequency
  std::string              note;          ///< omissions, or why there are no modes
};

template <class Visitor>
void describe(Visitor &v, const Ringing &x)
{
  v("begin", x.begin, "s", "start of the window");
  v("end", x.end, "s", "its end");
  v("step", x.step, "s", "interval of the samples");
  v("signals", x.signals, "", "signals that were fitted");
  v("residual", x.residual, "1", "residual of the fit, relative to the signals");
  v("modes", x.modes, "", "identified vibrations in ascending frequency");
  v("note", x.note, "", "omitted vibrations, or the reason why there are none");
}

/// Interval in which a wheel is off the ground.
struct LiftOff
{
  std::string wheel;
  double      begin = 0., end = 0.; ///< [s]; the end of the run if the wheel does not touch down
};

template <class Visitor>
void describe(Visitor &v, const LiftOff &x)
{
  v("wheel", x.wheel, "", "name of the wheel");
  v("from", x.begin, "s", "begin");
  v("to", x.end, "s", "end; that of the run if the wheel stays in the air");
}

struct StageResult
{
  std::vector<Stage>   stages; ///< up to the end of the run
  std::vector<LiftOff> lift_offs;
  Ringing              ringing; ///< without modes: not requested, or not found
};

template <class Visitor>
void describe_answer(Visitor &v, const StageResult &x)
{
  v.maybe(true, "stages", x.stages, "", "parts of the run between events");
  v.maybe(true, "lift_off", x.lift_offs, "", "wheels that lift off");
  v.maybe(true, "ringing", x.ringing, "", "vibrations identified in the last stage");
}

std::vector<Section> sections_of(const Result &result, const StageResult &found);

/// Intervals between the events "lift_off" and "touch_down" of each wheel; a wheel whose first event is "touch_down" is
/// off the ground from `begin`.
std::vector<LiftOff> lift_off_intervals(const coupling::RunResult &run, double begin, double end);

} // namespace gestell::apps
