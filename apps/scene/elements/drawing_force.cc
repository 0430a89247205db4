#include "mechanism/elements/drawing_force.h"

#include "apps/scene/read/checked.h"
#include "apps/scene/read/relative_motion.h"

namespace gestell::apps
{

/// Measure: displacement of `from` against `to`; the sheet resists.
void read_drawing_force(const SceneTable &table, const Names &names, Scene &scene)
{
  const auto                          motion = read_relative_motion(table, names);
  mechanism::DrawingForce::Parameters sheet;
  if (motion.rotation)
    throw table.error("acts along a displacement, not on an angle; name a slider in 'from' or give 'direction'");
  sheet.force      = table.positive("force", kind::force);
  sheet.stiffness  = table.positive("stiffness", kind::stiffness);
  sheet.contact_at = table.number("contact_at", kind::length, sheet.contact_at);
  sheet.depth      = table.positive("depth", kind::length, sheet.depth);
  add_element_on(scene, table, checked(table, [&] { return std::make_shared<mechanism::DrawingForce>(sheet); }),
                 motion);
}

} // namespace gestell::apps
