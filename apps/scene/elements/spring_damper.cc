#include "mechanism/elements/spring_damper.h"

#include "apps/scene/elements/element_types.h"
#include "apps/scene/read/relative_motion.h"

namespace gestell::apps
{

/// F = preload + c (u - rest) + b u' acts on `to` along the direction and on `from` in the opposite direction; on a
/// measure it opposes the increase.
void read_spring_damper(const SceneTable &table, const Names &names, Scene &scene)
{
  const auto motion = read_relative_motion(table, names);
  const auto spring = table.filled<mechanism::SpringDamper::Parameters>(motion.rotation);
  // A value may be varied down to zero; what is not given at all was forgotten.
  if (!table.has("stiffness") && !table.has("damping") && !table.has("preload"))
    throw table.error("needs 'stiffness', 'damping' or 'preload'; without them it has no effect");
  if (!motion.is_measure())
    scene.linear.push_back(
        {table.name(), motion.u, spring.stiffness, spring.damping, spring.preload, spring.rest, motion.force_unit()});
  else
    add_law<mechanism::SpringDamper>(scene, table, spring, motion);
}

ElementType spring_damper_type()
{
  using Spring = mechanism::SpringDamper::Parameters;
  return {"spring-damper",
          "Force F = preload + c (u - rest) + b u', acting on `to` along the direction and on `from` in the opposite "
          "direction.",
          "`force` (or `torque`), `displacement`, `rate`",
          joined({motion_keys(),
                  {key::number("stiffness", kind::stiffness, "stiffness c")
                       .on_angle(kind::torsional_stiffness)
                       .from_zero()
                       .by_default(&Spring::stiffness),
                   key::number("damping", kind::damping, "damping b")
                       .on_angle(kind::torsional_damping)
                       .from_zero()
                       .by_default(&Spring::damping),
                   key::number("preload", kind::force, "force at u = rest")
                       .on_angle(kind::torque)
                       .by_default(&Spring::preload),
                   key::number("rest", kind::length, "u at which the spring force is zero")
                       .on_angle(kind::angle)
                       .by_default(&Spring::rest)}}),
          read_spring_damper,
          {R"toml(from      = "slide"
stiffness = "200 N/mm"
damping   = "50 N s/m"
)toml"}};
}

} // namespace gestell::apps
