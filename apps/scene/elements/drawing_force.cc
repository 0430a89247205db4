#include "mechanism/elements/drawing_force.h"

#include "apps/scene/elements/element_types.h"
#include "apps/scene/read/relative_motion.h"

namespace gestell::apps
{

ElementType drawing_force_type()
{
  using Sheet = mechanism::DrawingForce::Parameters;
  return {
      "drawing force",
      "The sheet rises to a constant force and flows; after going back it resists only beyond the path drawn so far.",
      "`force`, `path`, `drawn`",
      joined({motion_keys(),
              {key::number("force", kind::force, "while the sheet flows").above_zero().into(&Sheet::force),
               key::number("stiffness", kind::stiffness, "of its rise and of unloading")
                   .above_zero()
                   .into(&Sheet::stiffness),
               key::number("contact_at", kind::length, "u at which the punch touches").by_default(&Sheet::contact_at),
               key::number("depth", kind::length, "at which the part is drawn through")
                   .above_zero()
                   .by_default(&Sheet::depth)}}),
      read_law<mechanism::DrawingForce, read_displacement>,
      {R"toml(from       = "slide"                 # rises over 0.4 mm, then 200 kN down to 60 mm
force      = "200 kN"
stiffness  = "500 kN/mm"
contact_at = "120 mm"
depth      = "60 mm"
)toml"}};
}

} // namespace gestell::apps
