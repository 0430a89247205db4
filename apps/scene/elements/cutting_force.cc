#include "mechanism/elements/cutting_force.h"

#include "apps/scene/elements/element_types.h"
#include "apps/scene/read/relative_motion.h"

namespace gestell::apps
{

/// Measure: displacement of `from` against `to`; the material resists.
void read_cutting_force(const SceneTable &table, const Names &names, Scene &scene)
{
  const auto                          motion = read_displacement(table, names);
  mechanism::CuttingForce::Parameters cut;
  cut.peak_force       = table.value("peak_force");
  cut.peak_penetration = table.value("peak_penetration");
  cut.contact_at       = table.value("contact_at");
  cut.speed            = table.value("speed");
  add_law<mechanism::CuttingForce>(scene, table, cut, motion);
}

ElementType cutting_force_type()
{
  const mechanism::CuttingForce::Parameters own;
  return {
      "cutting force",
      "The material resists while the tool goes in, with its largest force at one penetration.",
      "`force`, `penetration`",
      joined({motion_keys(),
              {key::number("peak_force", kind::force, "largest force").from_zero(),
               key::number("peak_penetration", kind::length, "at which it is largest").above_zero(),
               key::number("contact_at", kind::length, "u at which the tool touches").by_default(own.contact_at),
               key::number("speed", kind::speed, "below which the force fades").above_zero().by_default(own.speed)}}),
      read_cutting_force,
      {R"toml(from             = "slide"
peak_force       = "12 kN"
peak_penetration = "3 mm"
)toml"}};
}

} // namespace gestell::apps
