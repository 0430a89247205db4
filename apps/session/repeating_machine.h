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

/// The periodicity conditions of a machine, and their origin.
struct RepeatingMachine
{
  coupling::PeriodicProblem problem;
  coupling::PeriodicGuess   guess;  ///< initial guess of the search
  std::string               reason; ///< origin of the period, for people
};

/**
 * The period of a machine and its rotating coordinates.
 *
 * With oscillating loads and no free rotation, it is the least common period of their frequencies.  Angles that a motor
 * drives, that rotate initially and have no stiffness, advance by whole revolutions in an unknown period; the initial
 * angle of the slowest one is prescribed.  Planar bodies are simulated for a few revolutions to decide whether they
 * rotate or oscillate.  A machine without a drive is simulated until the amplitude of its oscillation is constant.
 *
 * @throws std::invalid_argument with the frequencies that have no common period, with the elements that depend on time
 * in an unknown period, or if a machine without a drive comes to rest
 */
RepeatingMachine repeating_machine(const Scene &scene, coupling::Machine &machine, const coupling::InitialState &start,
                                   const PeriodicRequest &request, const std::atomic<bool> *stop);

/// Integration method over a period: exact propagation, or that of [run] if exact propagation cannot treat the machine.
/// @throws std::invalid_argument if [run] is missing in the second case
coupling::MethodOptions periodic_integration(const Scene &scene, const coupling::Machine &machine);

/// Least common period [s] of all oscillating loads; 0: there are none.
/// @throws std::invalid_argument with the frequencies if they have none
double load_period(const Scene &scene, const coupling::Machine &machine);

/// A method for periodic solutions, and the reason for its choice.
struct ChosenMethod
{
  const coupling::PeriodicMethod *method = nullptr;
  std::string                     reason;
};

/// The method of this name; without a name the first one that can treat the machine (for small machines one that finds
/// all solutions).
/// @throws std::invalid_argument if it cannot treat the machine, with a method that can
ChosenMethod chosen_method(const RepeatingMachine &repeating, const std::string &name);

/// Options of the methods; a machine that exact propagation cannot treat is integrated as in [run].
coupling::PeriodicOptions periodic_options(const Scene &scene, const PeriodicRequest &request,
                                           const coupling::Machine &machine);

} // namespace gestell::apps
