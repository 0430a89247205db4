#pragma once

#include "coupling/integration/system/second_order_system.h"
#include "coupling/integration/system/time_integrator.h"

#include <string>

namespace gestell::coupling
{

/// Whether motion and forces of the measures are finite: checks a single sum, which is not finite if any term is not.
bool is_finite(const LocalState &state);

/// Message that names the values that are not finite.
std::string non_finite_state_message(const SecondOrderSystem &system, const LocalState &state);

/// One step of any method that ends in a finite state.
/// @throws ConvergenceFailure otherwise
void make_step(TimeIntegrator &integrator, const SecondOrderSystem &system);

} // namespace gestell::coupling
