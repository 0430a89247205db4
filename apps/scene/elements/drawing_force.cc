#include "mechanism/elements/drawing_force.h"

#include "apps/scene/elements/element_types.h"
#include "apps/scene/read/relative_motion.h"

namespace gestell::apps
{

/// Measure: displacement of `from` against `to`; the sheet resists.
void read_drawing_force(const SceneTable &table, const Names &names, Scene &scene)
{
  const auto                          motion = read_displacement(table, names);
  mechanism::DrawingForce::Parameters sheet;
  sheet.force      = table.value("force");
  sheet.stiffness  = table.value("stiffness");
  sheet.contact_at = table.value("contact_at");
  sheet.depth      = table.value("depth");
  add_law<mechanism::DrawingForce>(scene, table, sheet, motion);
}

ElementType drawing_force_type()
{
  const mechanism::DrawingForce::Parameters own;
  return {
      "drawing force",
      "The sheet rises to a constant force and flows; after going back it resists only beyond the path drawn so far.",
      "`force`, `path`, `drawn`",
      joined({motion_keys(),
              {key::number("force", kind::force, "while the sheet flows").above_zero(),
               key::number("stiffness", kind::stiffness, "of its rise and of unloading").above_zero(),
               key::number("contact_at", kind::length, "u at which the punch touches").by_default(own.contact_at),
               key::number("depth", kind::length, "at which the part is drawn through")
                   .above_zero()
                   .by_default(own.depth)}}),
      read_drawing_force,
      {R"toml(from       = "slide"                 # rises over 0.4 mm, then 200 kN down to 60 mm
force      = "200 kN"
stiffness  = "500 kN/mm"
contact_at = "120 mm"
depth      = "60 mm"
)toml"}};
}

} // namespace gestell::apps
