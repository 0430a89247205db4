#pragma once

#include "coupling/periodic/basins.h"
#include "coupling/periodic/periodic_solution.h"
#include "coupling/periodic/recurrence.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gestell::apps
{

/// A signal over one period: mean + sum_k amplitude_k cos(k Omega t + phase_k), with the drive's frequency Omega.
struct SignalOrbit
{
  std::string         name, unit;
  double              max = 0., min = 0., mean = 0.;
  std::vector<double> amplitude, phase; ///< of harmonic k + 1 of the drive; [rad]
};

/// A periodic solution with its signals.
struct PeriodicEntry
{
  coupling::PeriodicSolution solution;
  int                        branch    = 1;
  double                     parameter = 0.; ///< value of the continuation parameter, if there is one
  std::vector<SignalOrbit>   signals;
  std::vector<double>        rows; ///< of orbit_<solution>.csv: t, every signal; row major
};

/// A coordinate of the machine in terms of the motion that has this name: motion = sign * coordinate.
struct NamedCoordinate
{
  std::string name;
  double      sign;
};

/// A point on a branch where solutions begin, end or change their stability.
struct SpecialPoint
{
  std::string kind; ///< fold, period doubling, Neimark-Sacker, branch, grazing
  double      parameter = 0., period = 0.;
  int         solution = 0; ///< number of the nearest solution, from 1
};

/// Comparison with the same solution computed by a second method.
struct PeriodicCheck
{
  std::string                                 method;
  std::vector<std::pair<std::string, double>> distances; ///< by signal: largest difference relative to the amplitude
  std::string                                 failure;   ///< empty: none
};

/// A signal against its rate.
struct PhasePlane
{
  struct Curve
  {
    int                      solution = 0; ///< its number, from 1; 0: points of a section
    bool                     stable   = true;
    std::vector<double>      x, rate;
    std::vector<std::size_t> begins; ///< indices at which a period of the excitation begins
  };

  std::string        name, unit; ///< of the signal; the unit of the rate is this unit per second
  std::vector<Curve> curves;
};

/// Long-term behaviour of a motion, with its Poincare section.
struct LongRun
{
  coupling::Recurrence     motion;
  std::vector<std::string> columns; ///< of the signals, "name [unit]"
  std::vector<double>      rows;    ///< signals at the start of each period; row major
  std::vector<PhasePlane>  planes;  ///< the section in the planes of a few signals; none if it is a point
};

/// Which initial state settles to which solution; solutions by their numbers.
struct BasinMap
{
  std::string      x_name, y_name; ///< of coordinates; a rate ends with '
  coupling::Basins basins;
};

/// Result of `gestell periodic`.
struct PeriodicResult
{
  std::string                  method, reason;            ///< reason: of the choice of this method
  std::string                  parameter, parameter_unit; ///< continuation parameter; empty: none
  std::vector<NamedCoordinate> coordinates;               ///< of the machine
  std::vector<PeriodicEntry>   entries;
  std::vector<SpecialPoint>    special_points;
  std::vector<PeriodicCheck>   checks;
  std::vector<PeriodicEntry>   backbone; ///< free vibration, if the parameter is a load's frequency
  std::vector<PhasePlane>      planes;   ///< the first solutions, in some signals whose rates are known exactly
  std::optional<LongRun>       long_run;
  std::optional<BasinMap>      basins;
  coupling::PeriodicWork       work;
  std::vector<std::string>     notes;   ///< of branches
  std::string                  failure; ///< not empty: reason for an early end
  bool                         interrupted = false;
};

/// "periodic", "sub-harmonic 1/2"
std::string kind_of(const coupling::PeriodicSolution &solution);

template <class Visitor>
void describe(Visitor &v, const SignalOrbit &x)
{
  v("unit", x.unit, "", "of the signal");
  v("max", x.max, x.unit, "largest value of a period");
  v("min", x.min, x.unit, "smallest value");
  v("mean", x.mean, x.unit, "mean value");
  v("amplitudes", x.amplitude, x.unit, "of the harmonics of the drive");
  v("phases", x.phase, "rad", "of the harmonics of the drive");
}

template <class Visitor>
void describe(Visitor &v, const SpecialPoint &x)
{
  v("kind", x.kind, "", "fold, period doubling, Neimark-Sacker, branch or grazing");
  v("parameter", x.parameter, "", "value of the parameter");
  v("period", x.period, "s", "period of the solution");
  v("solution", x.solution, "", "number of the nearest solution");
}

template <class Visitor>
void describe(Visitor &v, const PeriodicCheck &x)
{
  v("method", x.method, "", "of the check");
  v("distances", x.distances, "1", "largest difference of each signal relative to its amplitude");
  v("failure", x.failure.empty() ? std::nullopt : std::optional(x.failure), "",
    "reason why there is none; null: there is one");
}

} // namespace gestell::apps
