#pragma once

#include "coupling/integration/system/second_order_system.h"
#include "coupling/integration/system/time_integrator.h"

#include <string>

namespace gestell::coupling
{

/// Whether motion and forces of the measures are numbers: by one sum, which any that is none spoils.
bool is_finite(const LocalState &state);

/// Which of them is none, for messages.
std::string non_finite_state_message(const SecondOrderSystem &system, const LocalState &state);

/// A step of any method ends in a state, whatever looks on; else it is given up.
/// @throws ConvergenceFailure
void make_step(TimeIntegrator &integrator, const SecondOrderSystem &system);

} // namespace gestell::coupling
