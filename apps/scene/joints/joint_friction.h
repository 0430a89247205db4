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
  std::optional<mechanism::CoulombFriction::Parameters> dry;      ///< true sticking
  std::optional<mechanism::LuGreFriction::Parameters>   bristles; ///< elastic sticking
  double radius = 0., length = 0.;                                ///< [m] of a pin, of a guide that transmits moments
};

/// `friction` of a joint: a coefficient or its table.
Key joint_friction_key();

/// Reads `friction` of joints with sliding surfaces; null without it.
std::shared_ptr<const JointFrictionRequest> read_joint_friction(const SceneTable &table, const JointType &type);

/// Rotation of the second body relative to the first: for a pin about `axis`, which is needed only for bodies in space.
mechanism::RelativeMeasure rotation_of_pin(const Pair &pair, const mechanism::Vector3d &axis);

/**
 * Adds friction in the free directions of the joint attached last, with normal forces by the multipliers of
 * `equations`.
 *
 * @throws std::invalid_argument if the bodies have no such motion, or friction with sticking has no constant direction
 */
void add_joint_friction(coupling::MachineModel &machine, const JointRequest &joint, const FrictionForm &form,
                        const Pair &pair, const std::vector<mechanism::IdealJoint::Equation> &equations);

} // namespace gestell::apps
