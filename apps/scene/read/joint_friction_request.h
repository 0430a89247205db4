#pragma once

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

} // namespace gestell::apps
