#include "mechanism/elements/blanking_force.h"

#include "apps/scene/read/checked.h"
#include "apps/scene/read/relative_motion.h"

namespace gestell::apps
{

/// Measure: displacement of `from` against `to`; the sheet resists.
void read_blanking_force(const SceneTable &table, const Names &names, Scene &scene)
{
  const auto                           motion = read_relative_motion(table, names);
  mechanism::BlankingForce::Parameters sheet;
  if (motion.rotation)
    throw table.error("acts along a displacement, not on an angle; name a slider in 'from' or give 'direction'");
  sheet.thickness            = table.positive("thickness", kind::length);
  sheet.cut_length           = table.positive("cut_length", kind::length);
  sheet.shear_resistance     = table.positive("shear_resistance", kind::pressure);
  sheet.peak_penetration     = table.positive("peak_penetration", kind::number, sheet.peak_penetration);
  sheet.rise_exponent        = table.positive("rise_exponent", kind::number, sheet.rise_exponent);
  sheet.fracture_penetration = table.positive("fracture_penetration", kind::number, sheet.fracture_penetration);
  sheet.friction_share       = table.not_negative("friction_share", kind::number, sheet.friction_share);
  sheet.elastic_stiffness    = table.positive("elastic_stiffness", kind::stiffness);
  sheet.contact_at           = table.number("contact_at", kind::length);
  add_element_on(scene, table, checked(table, [&] { return std::make_shared<mechanism::BlankingForce>(sheet); }),
                 motion);
}

} // namespace gestell::apps
