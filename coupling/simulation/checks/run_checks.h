#pragma once

#include "coupling/integration/events/motion.h"
#include "coupling/machine/initial_state.h"
#include "coupling/machine/machine.h"
#include "coupling/simulation/run_result.h"

#include <memory>
#include <string>
#include <vector>

namespace gestell::coupling
{

/// Checks a run before its first step.
/// @return  numerical damping and period error of each mode
/// @throws std::invalid_argument as StabilityGuard::check() does, unless options.force_unstable is set
std::vector<ModeAccuracy> check_start(const Machine &machine, const InitialState &initial, const RunOptions &options,
                                      const MethodOptions &method, RunOutcome &outcome);

/// All checks of a running motion except the energy balance (EnergyCheck), in the order of their findings. Arguments
/// must outlive them.
std::vector<std::unique_ptr<RunObserver>> run_checks(Machine &machine, const Motion &motion,
                                                     const InitialState &initial, const RunOptions &options,
                                                     const MethodOptions &method);

/// Failures of functions of the calling program after t, in force laws, for messages; empty: none.
std::string faults_of(const Machine &machine, double t);

/// Possible causes of a failed step, for its message; empty: none is known.
std::string advice_on_failure(const Machine &machine, const MethodOptions &method, const Instant &last);

} // namespace gestell::coupling
