#include "mechanism/elements/blanking_force.h"

#include "apps/scene/elements/element_types.h"
#include "apps/scene/read/relative_motion.h"

namespace gestell::apps
{

/// Measure: displacement of `from` against `to`; the sheet resists.
void read_blanking_force(const SceneTable &table, const Names &names, Scene &scene)
{
  const auto                           motion = read_displacement(table, names);
  mechanism::BlankingForce::Parameters sheet;
  sheet.thickness            = table.value("thickness");
  sheet.cut_length           = table.value("cut_length");
  sheet.shear_resistance     = table.value("shear_resistance");
  sheet.peak_penetration     = table.value("peak_penetration");
  sheet.rise_exponent        = table.value("rise_exponent");
  sheet.fracture_penetration = table.value("fracture_penetration");
  sheet.friction_share       = table.value("friction_share");
  sheet.elastic_stiffness    = table.value("elastic_stiffness");
  sheet.contact_at           = table.value("contact_at");
  add_law<mechanism::BlankingForce>(scene, table, sheet, motion);
}

ElementType blanking_force_type()
{
  const mechanism::BlankingForce::Parameters own;
  return {"blanking force",
          "The sheet resists a punch until it breaks.",
          "`force`, `penetration`, `largest_penetration` (at most the thickness)",
          joined({motion_keys(),
                  {key::number("thickness", kind::length, "of the sheet").above_zero(),
                   key::number("cut_length", kind::length, "of the edge cut").above_zero(),
                   key::number("shear_resistance", kind::pressure, "of the sheet").above_zero(),
                   key::number("elastic_stiffness", kind::stiffness, "of the sheet before it flows").above_zero(),
                   key::number("contact_at", kind::length, "u at which the punch touches"),
                   key::number("peak_penetration", kind::number, "at the largest force, as a share of the thickness")
                       .above_zero()
                       .by_default(own.peak_penetration),
                   key::number("fracture_penetration", kind::number, "at the fracture, as a share of the thickness")
                       .above_zero()
                       .by_default(own.fracture_penetration),
                   key::number("rise_exponent", kind::number, "of the rise of the force")
                       .above_zero()
                       .by_default(own.rise_exponent),
                   key::number("friction_share", kind::number, "of the force after the fracture")
                       .from_zero()
                       .by_default(own.friction_share)}}),
          read_blanking_force,
          {R"toml(from              = "slide"
thickness         = "4 mm"
cut_length        = "400 mm"
shear_resistance  = "300 MPa"
elastic_stiffness = "4000 kN/mm"
contact_at        = "150 mm"
)toml"}};
}

} // namespace gestell::apps
