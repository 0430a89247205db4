#include "mechanism/elements/cutting_force.h"

#include "apps/scene/read/checked.h"
#include "apps/scene/read/relative_motion.h"

namespace gestell::apps
{

/// Measure: displacement of `from` against `to`; the material resists.
void read_cutting_force(const SceneTable &table, const Names &names, Scene &scene)
{
  const auto                          motion = read_relative_motion(table, names);
  mechanism::CuttingForce::Parameters cut;
  if (motion.rotation)
    throw table.error("acts along a displacement, not on an angle; name a slider in 'from' or give 'direction'");
  cut.peak_force       = table.not_negative("peak_force", kind::force);
  cut.peak_penetration = table.positive("peak_penetration", kind::length);
  cut.contact_at       = table.number("contact_at", kind::length, cut.contact_at);
  cut.speed            = table.positive("speed", kind::speed, cut.speed);
  add_element_on(scene, table, checked(table, [&] { return std::make_shared<mechanism::CuttingForce>(cut); }), motion);
}

} // namespace gestell::apps
