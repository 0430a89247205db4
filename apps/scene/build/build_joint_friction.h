#pragma once

#include "apps/scene/build/joint_equations.h"

namespace gestell::apps
{

/**
 * Friction against the motions that the joint attached last leaves free; it sees the multipliers of its `equations`.
 *
 * @throws std::invalid_argument where the bodies have no such motion, or friction that sticks has no constant direction
 */
void add_joint_friction(coupling::MachineModel &machine, const JointRequest &joint, const Pair &pair,
                        const std::vector<mechanism::IdealJoint::Equation> &equations);

} // namespace gestell::apps
