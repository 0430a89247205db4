#include "mechanism/elements/lugre_friction.h"

#include "apps/scene/elements/element_types.h"
#include "apps/scene/read/relative_motion.h"

namespace gestell::apps
{

/// Measures: displacement or angle of `from` against `to`; the force of the bristles, a lag.
void read_lugre_friction(const SceneTable &table, const Names &names, Scene &scene)
{
  const auto motion   = constant_motion(read_relative_motion(table, names), names);
  const auto friction = table.filled<mechanism::LuGreFriction::Parameters>(motion.rotation);
  if (friction.static_force > friction.kinetic_force && !table.has("stribeck_speed"))
    throw table.error("needs 'stribeck_speed', the speed over which the force falls from static to kinetic friction");
  add_law<mechanism::LuGreFriction>(scene, table, friction, motion,
                                    {{table.name() + ".bristles", mechanism::LuGreFriction::lag()}});
}

ElementType lugre_friction_type()
{
  using Friction = mechanism::LuGreFriction::Parameters;
  return {"lugre friction",
          "LuGre friction: presliding by elastic bristles. Method `bdf` only.",
          "`force`, `rate`, `deflection`",
          joined({motion_keys(),
                  {key::number("kinetic_force", kind::force, "friction force while sliding")
                       .on_angle(kind::torque)
                       .above_zero()
                       .into(&Friction::kinetic_force),
                   key::number("static_force", kind::force, "friction force at the end of presliding")
                       .on_angle(kind::torque)
                       .above_zero()
                       .same_as("kinetic_force")
                       .into(&Friction::static_force),
                   key::number("stribeck_speed", kind::speed, "Stribeck speed of the transition to kinetic friction")
                       .on_angle(kind::angular_speed)
                       .above_zero()
                       .by_default(&Friction::stribeck_speed),
                   key::number("stribeck_exponent", kind::number, "exponent of the transition")
                       .above_zero()
                       .by_default(&Friction::stribeck_exponent),
                   key::number("bristle_stiffness", kind::stiffness, "stiffness of the bristles")
                       .on_angle(kind::torsional_stiffness)
                       .above_zero()
                       .into(&Friction::bristle_stiffness),
                   key::number("bristle_damping", kind::damping, "damping of the bristles")
                       .on_angle(kind::torsional_damping)
                       .from_zero()
                       .by_default(&Friction::bristle_damping),
                   key::number("viscous", kind::damping, "viscous damping, in addition")
                       .on_angle(kind::torsional_damping)
                       .from_zero()
                       .by_default(&Friction::viscous)}}),
          read_lugre_friction,
          {R"toml(from              = "slide"
static_force      = "120 N"
kinetic_force     = "80 N"
stribeck_speed    = "20 mm/s"
bristle_stiffness = "50 N/um"
bristle_damping   = "2 kN s/m"
)toml"}};
}

} // namespace gestell::apps
