#pragma once

#include "apps/scene/scene.h"
#include "apps/session/periodic_request.h"
#include "coupling/machine/initial_state.h"
#include "coupling/machine/machine.h"
#include "coupling/periodic/periodic_method.h"

#include <atomic>
#include <string>

namespace gestell::apps
{

/// What of a machine is to repeat, and why.
struct RepeatingMachine
{
  coupling::PeriodicProblem problem;
  coupling::PeriodicGuess   guess;  ///< where the search begins
  std::string               reason; ///< where the period comes from, for people
};

/**
 * The period of a machine and what turns in it.
 *
 * Loads that oscillate, and nothing that turns freely: the least common period of their frequencies.  Angles that turn
 * at the start without stiffness against it, driven by a motor: they come round after whole turns, in a period that is
 * unknown; the slowest of them keeps its angle at the begin.  Planar bodies are followed for some turns, to see whether
 * they turn or swing.  A machine that nothing drives is followed until its oscillation keeps its size.
 *
 * @throws std::invalid_argument with the frequencies that have no common period, the elements that tell of the time
 * without a period being known, or where nothing drives the machine and it comes to rest
 */
RepeatingMachine repeating_machine(const Scene &scene, coupling::Machine &machine, const coupling::InitialState &start,
                                   const PeriodicRequest &request, const std::atomic<bool> *stop);

/// Integration of its periods: exact propagation, or that of [run] where it cannot carry the machine.
/// @throws std::invalid_argument if there is no [run] then
coupling::MethodOptions periodic_integration(const Scene &scene, const coupling::Machine &machine);

/// Least common period [s] of all loads that oscillate; 0: none does.
/// @throws std::invalid_argument with the frequencies if they have none
double load_period(const Scene &scene, const coupling::Machine &machine);

} // namespace gestell::apps
