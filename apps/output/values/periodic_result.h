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

/// A signal over one period: mean + sum_k amplitude_k cos(k Omega t + phase_k), Omega that of the drive.
struct SignalOrbit
{
  std::string         name, unit;
  double              max = 0., min = 0., mean = 0.;
  std::vector<double> amplitude, phase; ///< of harmonic k + 1 of the drive; [rad]
};

/// A periodic motion with its signals.
struct PeriodicEntry
{
  coupling::PeriodicSolution solution;
  int                        branch    = 1;
  double                     parameter = 0.; ///< where one is followed
  std::vector<SignalOrbit>   signals;
  std::vector<double>        rows; ///< of orbit_<solution>.csv: t, every signal; row major
};

/// A coordinate of the machine, by the motion that has this name: motion = sign * coordinate.
struct NamedCoordinate
{
  std::string name;
  double      sign;
};

/// A place on a branch where motions begin, end or change their stability.
struct SpecialPoint
{
  std::string kind; ///< fold, period doubling, Neimark-Sacker, branch, grazing
  double      parameter = 0., period = 0.;
  int         solution = 0; ///< number of the nearest one, from 1
};

/// A second way to the same motion.
struct PeriodicCheck
{
  std::string                                 method;
  std::vector<std::pair<std::string, double>> distances; ///< by signal: largest difference over its amplitude
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
    std::vector<std::size_t> begins; ///< where a period of the excitation begins
  };

  std::string        name, unit; ///< of the signal; the rate's is the unit per second
  std::vector<Curve> curves;
};

/// What a motion does in the long run, with its Poincare section.
struct LongRun
{
  coupling::Recurrence     motion;
  std::vector<std::string> columns; ///< of the signals, "name [unit]"
  std::vector<double>      rows;    ///< signals at the begins of the periods; row major
  std::vector<PhasePlane>  planes;  ///< the section in a few signals; none where it is a point
};

/// Which start settles to which motion; motions by their numbers.
struct BasinMap
{
  std::string      x_name, y_name; ///< of coordinates, with ' of rates
  coupling::Basins basins;
};

/// What `gestell periodic` finds.
struct PeriodicResult
{
  std::string                  method, reason;            ///< why this method
  std::string                  parameter, parameter_unit; ///< that is followed; empty: none
  std::vector<NamedCoordinate> coordinates;               ///< of the machine
  std::vector<PeriodicEntry>   entries;
  std::vector<SpecialPoint>    special_points;
  std::vector<PeriodicCheck>   checks;
  std::vector<PeriodicEntry>   backbone; ///< of free vibration, where the parameter is a load's frequency
  std::vector<PhasePlane>      planes;   ///< the first solutions in some signals whose rates are known exactly
  std::optional<LongRun>       long_run;
  std::optional<BasinMap>      basins;
  coupling::PeriodicWork       work;
  std::vector<std::string>     notes;   ///< of branches
  std::string                  failure; ///< not empty: why it ended early
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
  v("period", x.period, "s", "of the motion");
  v("solution", x.solution, "", "number of the nearest solution");
}

template <class Visitor>
void describe(Visitor &v, const PeriodicCheck &x)
{
  v("method", x.method, "", "of the check");
  v("distances", x.distances, "1", "by signal: largest difference over its amplitude");
  v("failure", x.failure.empty() ? std::nullopt : std::optional(x.failure), "", "why there is none; null: there is");
}

} // namespace gestell::apps
