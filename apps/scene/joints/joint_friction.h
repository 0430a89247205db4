#pragma once

#include "apps/scene/joints/joint_type.h"
#include "mechanism/elements/coulomb_friction.h"
#include "mechanism/elements/lugre_friction.h"
#include "mechanism/sliding_friction.h"

#include <optional>

namespace gestell::apps
{

/// Friction by one of three laws; forces are per unit of the normal force of the joint.
struct JointFrictionRequest
{
  mechanism::SlidingFriction                            smooth;
  std::optional<mechanism::CoulombFriction::Parameters> dry;      ///< sticks truly
  std::optional<mechanism::LuGreFriction::Parameters>   bristles; ///< sticks elastically
  double radius = 0., length = 0.;                                ///< [m] of a pin, of a guide that takes torques
};

/// `friction` of a joint: a coefficient or its table.
Key joint_friction_key();

/// `friction` of the joints that slide along a surface; null without it.
std::shared_ptr<const JointFrictionRequest> read_joint_friction(const SceneTable &table, const JointType &type);

/// Rotation of the second body against the first: of a pin about `axis`, which only bodies in space need.
mechanism::RelativeMeasure rotation_of_pin(const Pair &pair, const mechanism::Vector3d &axis);

/**
 * Friction against the motions that the joint attached last leaves free; it sees the multipliers of its `equations`.
 *
 * @throws std::invalid_argument where the bodies have no such motion, or friction that sticks has no constant direction
 */
void add_joint_friction(coupling::MachineModel &machine, const JointRequest &joint, const FrictionForm &form,
                        const Pair &pair, const std::vector<mechanism::IdealJoint::Equation> &equations);

} // namespace gestell::apps
