#include "mechanism/elements/wheel.h"

#include "apps/scene/elements/element_types.h"
#include "apps/scene/read/relative_motion.h"

namespace gestell::apps
{

/// Measure: height of the hub above the position in which the tyre is just unloaded.
void read_wheel(const SceneTable &table, const Names &names, Scene &scene)
{
  const auto motion = read_relative_motion(table, names);
  if (motion.rotation)
    throw table.error("needs a displacement, not an angle; give 'direction' or a measure of a length");
  add_law<mechanism::Wheel>(scene, table, table.filled<mechanism::Wheel::Parameters>(), motion);
}

ElementType wheel_type()
{
  using Wheel = mechanism::Wheel::Parameters;
  return {"wheel",
          "Tyre on the ground that can lift off: F = -c u - d u' pushes upwards; u is the height of the hub above the "
          "position in which the tyre is just unloaded.",
          "`force`, `compression`",
          joined({motion_keys(),
                  {key::number("stiffness", kind::stiffness, "tyre stiffness c").above_zero().into(&Wheel::stiffness),
                   key::number("damping", kind::damping, "tyre damping d").from_zero().by_default(&Wheel::damping),
                   key::truth("bilateral", false, "the tyre never lifts off").into(&Wheel::bilateral)}}),
          read_wheel,
          {R"toml(from      = "slide"
stiffness = "600 N/mm"
)toml"}};
}

} // namespace gestell::apps
