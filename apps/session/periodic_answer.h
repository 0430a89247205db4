#pragma once

#include "apps/output/values/periodic_result.h"
#include "apps/session/prepared_machine.h"
#include "apps/session/repeating_machine.h"
#include "coupling/periodic/periodic_method.h"
#include "coupling/simulation/simulation.h"

#include <optional>
#include <string>
#include <vector>

namespace gestell::apps
{

/// A way to periodic motions, and why this one.
struct ChosenMethod
{
  const coupling::PeriodicMethod *method = nullptr;
  std::string                     reason;
};

/// By its name; none: the first that can treat the machine, all solutions of small ones.
/// @throws std::invalid_argument where it cannot, with what serves instead
ChosenMethod chosen_method(const RepeatingMachine &repeating, const std::string &name);

/// That every option is taken by the method, or by the one it is checked by.
/// @throws std::invalid_argument
void check_options(const PeriodicRequest &request, const coupling::PeriodicMethod &method);

/// What methods obey; a machine that exact propagation cannot carry is integrated as [run] says.
coupling::PeriodicOptions periodic_options(const Scene &scene, const PeriodicRequest &request,
                                           const coupling::Machine &machine);

/// The motion as one of its own period, computed anew, if it repeats earlier than after `solution.ratio` periods of the
/// excitation.
coupling::PeriodicSolution of_own_period(const coupling::PeriodicMethod   &method,
                                         const coupling::PeriodicProblem  &problem,
                                         const coupling::PeriodicSolution &solution,
                                         const coupling::PeriodicOptions  &options);

/// What is kept of a run over a period besides the signals.
enum class OrbitRun
{
  signals,
  pictures ///< and the energy balance
};

/// One period of a solution as a run of the machine, begun on it.
coupling::RunResult orbit_run(coupling::Machine &machine, const coupling::PeriodicSolution &solution,
                              const std::vector<coupling::Signal> &signals, int rows,
                              OrbitRun keep = OrbitRun::pictures);

/// The solution with its signals: extremes, harmonics, rows.
/// @param run  becomes the run of one period that tells them; left as it is of a motion that is a series
PeriodicEntry entry_of(coupling::Machine &machine, const coupling::PeriodicProblem &problem,
                       const coupling::PeriodicSolution &solution, const std::vector<coupling::Signal> &signals,
                       int rows, std::optional<coupling::RunResult> *run = nullptr);

/// How far two solutions are apart in their signals.
PeriodicCheck compared(const PeriodicEntry &first, const PeriodicEntry &second, const std::string &method);

} // namespace gestell::apps
