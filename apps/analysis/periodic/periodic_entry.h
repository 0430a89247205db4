#pragma once

#include "apps/output/values/periodic_result.h"
#include "apps/session/repeating_machine.h"
#include "coupling/periodic/periodic_method.h"
#include "coupling/simulation/simulation.h"

#include <optional>
#include <string>
#include <vector>

namespace gestell::apps
{

/// Checks that the method, or the one that verifies it, accepts every option.
/// @throws std::invalid_argument
void check_options(const PeriodicRequest &request, const coupling::PeriodicMethod &method);

/// The solution over its own period, recomputed, if it repeats earlier than after `solution.ratio` periods of the
/// excitation.
coupling::PeriodicSolution of_own_period(const coupling::PeriodicMethod   &method,
                                         const coupling::PeriodicProblem  &problem,
                                         const coupling::PeriodicSolution &solution,
                                         const coupling::PeriodicOptions  &options);

/// Data stored from a run over a period in addition to the signals.
enum class OrbitRun
{
  signals,
  pictures ///< with the energy balance
};

/// One period of a solution as a run of the machine that starts on it.
coupling::RunResult orbit_run(coupling::Machine &machine, const coupling::PeriodicSolution &solution,
                              const std::vector<coupling::Signal> &signals, int rows,
                              OrbitRun keep = OrbitRun::pictures);

/// The solution with its signals: extremes, harmonics, rows.
/// @param run  receives the run of one period with these signals; unchanged if the solution is given as a series
PeriodicEntry entry_of(coupling::Machine &machine, const coupling::PeriodicProblem &problem,
                       const coupling::PeriodicSolution &solution, const std::vector<coupling::Signal> &signals,
                       int rows, std::optional<coupling::RunResult> *run = nullptr);

/// Distance between two solutions in their signals.
PeriodicCheck compared(const PeriodicEntry &first, const PeriodicEntry &second, const std::string &method);

} // namespace gestell::apps
