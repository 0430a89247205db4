#include "mechanism/elements/rope.h"

#include "apps/scene/elements/element_types.h"
#include "apps/scene/read/relative_motion.h"

namespace gestell::apps
{

ElementType rope_type()
{
  using Rope = mechanism::Rope::Parameters;
  return {
      "rope",
      "Rope: pulls for u > slack, never pushes.",
      "`force`, `elongation`",
      joined({motion_keys(),
              {key::number("stiffness", kind::stiffness, "stiffness of the rope")
                   .on_angle(kind::torsional_stiffness)
                   .above_zero()
                   .into(&Rope::stiffness),
               key::number("damping", kind::damping, "damping of the taut rope")
                   .on_angle(kind::torsional_damping)
                   .from_zero()
                   .by_default(&Rope::damping),
               key::number("slack", kind::length, "u at which the rope becomes taut; if negative, it is taut at u = 0")
                   .on_angle(kind::angle)
                   .by_default(&Rope::slack)}}),
      read_law<mechanism::Rope>,
      {R"toml(from      = "slide"                  # never pushes
stiffness = "900 N/mm"
damping   = "2 kN s/m"
slack     = "5 mm"
)toml"}};
}

} // namespace gestell::apps
