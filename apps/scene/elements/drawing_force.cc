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
      "Deep drawing: the force rises to a constant value while the sheet flows. After a return stroke it acts only "
      "beyond the depth drawn so far.",
      "`force`, `path`, `drawn`",
      joined(
          {motion_keys(),
           {key::number("force", kind::force, "force while the sheet flows").above_zero().into(&Sheet::force),
            key::number("stiffness", kind::stiffness, "stiffness of the rise and of unloading")
                .above_zero()
                .into(&Sheet::stiffness),
            key::number("contact_at", kind::length, "u at first contact of the punch").by_default(&Sheet::contact_at),
            key::number("depth", kind::length, "drawing depth at which the part is finished")
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
