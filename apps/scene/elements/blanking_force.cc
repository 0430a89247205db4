#include "mechanism/elements/blanking_force.h"

#include "apps/scene/elements/element_types.h"
#include "apps/scene/read/relative_motion.h"

namespace gestell::apps
{

ElementType blanking_force_type()
{
  using Sheet = mechanism::BlankingForce::Parameters;
  return {
      "blanking force",
      "The sheet resists a punch until it breaks.",
      "`force`, `penetration`, `largest_penetration` (at most the thickness)",
      joined(
          {motion_keys(),
           {key::number("thickness", kind::length, "of the sheet").above_zero().into(&Sheet::thickness),
            key::number("cut_length", kind::length, "of the edge cut").above_zero().into(&Sheet::cut_length),
            key::number("shear_resistance", kind::pressure, "of the sheet").above_zero().into(&Sheet::shear_resistance),
            key::number("elastic_stiffness", kind::stiffness, "of the sheet before it flows")
                .above_zero()
                .into(&Sheet::elastic_stiffness),
            key::number("contact_at", kind::length, "u at which the punch touches").into(&Sheet::contact_at),
            key::number("peak_penetration", kind::number, "at the largest force, as a share of the thickness")
                .above_zero()
                .by_default(&Sheet::peak_penetration),
            key::number("fracture_penetration", kind::number, "at the fracture, as a share of the thickness")
                .above_zero()
                .by_default(&Sheet::fracture_penetration),
            key::number("rise_exponent", kind::number, "of the rise of the force")
                .above_zero()
                .by_default(&Sheet::rise_exponent),
            key::number("friction_share", kind::number, "of the force after the fracture")
                .from_zero()
                .by_default(&Sheet::friction_share)}}),
      read_law<mechanism::BlankingForce, read_displacement>,
      {R"toml(from              = "slide"
thickness         = "4 mm"
cut_length        = "400 mm"
shear_resistance  = "300 MPa"
elastic_stiffness = "4000 kN/mm"
contact_at        = "150 mm"
)toml"}};
}

} // namespace gestell::apps
