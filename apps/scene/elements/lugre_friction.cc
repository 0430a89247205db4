#include "mechanism/elements/lugre_friction.h"

#include "apps/scene/read/checked.h"
#include "apps/scene/read/relative_motion.h"

namespace gestell::apps
{

/// Measures: displacement or angle of `from` against `to`; the force of the bristles, a lag.
void read_lugre_friction(const SceneTable &table, const Names &names, Scene &scene)
{
  const auto  motion    = constant_motion(read_relative_motion(table, names), names);
  const bool  turns     = motion.rotation;
  const Kind &force     = turns ? kind::torque : kind::force;
  const Kind &stiffness = turns ? kind::torsional_stiffness : kind::stiffness;
  const Kind &damping   = turns ? kind::torsional_damping : kind::damping;

  mechanism::LuGreFriction::Parameters friction;
  friction.kinetic_force     = table.positive("kinetic_force", force);
  friction.static_force      = table.positive("static_force", force, friction.kinetic_force);
  friction.stribeck_speed    = table.positive("stribeck_speed", turns ? kind::angular_speed : kind::speed, 0.);
  friction.stribeck_exponent = table.positive("stribeck_exponent", kind::number, friction.stribeck_exponent);
  friction.bristle_stiffness = table.positive("bristle_stiffness", stiffness);
  friction.bristle_damping   = table.not_negative("bristle_damping", damping, 0.);
  friction.viscous           = table.not_negative("viscous", damping, 0.);
  if (friction.static_force > friction.kinetic_force && !table.has("stribeck_speed"))
    throw table.error("needs 'stribeck_speed', over which the force falls from the static to the kinetic one");
  add_element_on(scene, table, checked(table, [&] { return std::make_shared<mechanism::LuGreFriction>(friction); }),
                 motion, {{table.name() + ".bristles", mechanism::LuGreFriction::lag()}});
}

} // namespace gestell::apps
