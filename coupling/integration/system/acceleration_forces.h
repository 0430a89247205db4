#pragma once

#include "coupling/integration/system/second_order_system.h"

#include <string>

namespace gestell::coupling
{

/// Whether a force depends on u'' at a motion; that of an unbalance does at any motion.
bool depend_on_accelerations(const SecondOrderSystem &system, const LocalState &at);

/// Rejects forces that depend on u'' at a motion, such as those of an unbalance, for a method without accelerations in
/// its state.
/// @param method  for the message: "exact"
/// @throws std::invalid_argument
void refuse_acceleration_forces(const SecondOrderSystem &system, const LocalState &at, const std::string &method);

} // namespace gestell::coupling
