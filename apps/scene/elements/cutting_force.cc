#include "mechanism/elements/cutting_force.h"

#include "apps/scene/elements/element_types.h"
#include "apps/scene/read/relative_motion.h"

namespace gestell::apps
{

ElementType cutting_force_type()
{
  using Cut = mechanism::CuttingForce::Parameters;
  return {
      "cutting force",
      "Resistance of the material while the tool penetrates, with its maximum at a given penetration.",
      "`force`, `penetration`",
      joined({motion_keys(),
              {key::number("peak_force", kind::force, "largest force").from_zero().into(&Cut::peak_force),
               key::number("peak_penetration", kind::length, "penetration at the largest force")
                   .above_zero()
                   .into(&Cut::peak_penetration),
               key::number("contact_at", kind::length, "u at first contact of the tool").by_default(&Cut::contact_at),
               key::number("speed", kind::speed, "speed below which the force fades")
                   .above_zero()
                   .by_default(&Cut::speed)}}),
      read_law<mechanism::CuttingForce, read_displacement>,
      {R"toml(from             = "slide"
peak_force       = "12 kN"
peak_penetration = "3 mm"
)toml"}};
}

} // namespace gestell::apps
