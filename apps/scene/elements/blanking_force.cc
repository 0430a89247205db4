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
      "Resistance of a sheet to a punch until the sheet fractures.",
      "`force`, `penetration`, `largest_penetration` (at most the thickness)",
      joined(
          {motion_keys(),
           {key::number("thickness", kind::length, "thickness of the sheet").above_zero().into(&Sheet::thickness),
            key::number("cut_length", kind::length, "length of the cut edge").above_zero().into(&Sheet::cut_length),
            key::number("shear_resistance", kind::pressure, "shear resistance of the sheet")
                .above_zero()
                .into(&Sheet::shear_resistance),
            key::number("elastic_stiffness", kind::stiffness, "stiffness of the sheet before it yields")
                .above_zero()
                .into(&Sheet::elastic_stiffness),
            key::number("contact_at", kind::length, "u at first contact of the punch").into(&Sheet::contact_at),
            key::number("peak_penetration", kind::number, "penetration at the largest force, relative to the thickness")
                .above_zero()
                .by_default(&Sheet::peak_penetration),
            key::number("fracture_penetration", kind::number, "penetration at fracture, relative to the thickness")
                .above_zero()
                .by_default(&Sheet::fracture_penetration),
            key::number("rise_exponent", kind::number, "exponent of the force rise")
                .above_zero()
                .by_default(&Sheet::rise_exponent),
            key::number("friction_share", kind::number,
                        "share of the peak force that remains as friction after fracture")
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
