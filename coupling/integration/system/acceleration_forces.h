#pragma once

#include "coupling/integration/system/second_order_system.h"

#include <string>

namespace gestell::coupling
{

/// Whether a force depends on u'' at a motion, as those of an unbalance do at any.
bool depend_on_accelerations(const SecondOrderSystem &system, const LocalState &at);

/// Refuses forces that depend on u'' at a motion, as those of an unbalance do, for a method that does not carry
/// accelerations; at any motion of an unbalance.
/// @param method  for the message: "exact"
/// @throws std::invalid_argument
void refuse_acceleration_forces(const SecondOrderSystem &system, const LocalState &at, const std::string &method);

} // namespace gestell::coupling
