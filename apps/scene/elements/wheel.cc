#include "mechanism/elements/wheel.h"

#include "apps/scene/read/checked.h"
#include "apps/scene/read/relative_motion.h"

namespace gestell::apps
{

/// Measure: height of the hub above the position in which the tyre is just unloaded.
void read_wheel(const SceneTable &table, const Names &names, Scene &scene)
{
  const auto motion = read_relative_motion(table, names);
  if (motion.rotation)
    throw table.error("stands on the ground along a displacement, not on an angle; give 'direction' or a measure of a "
                      "length");
  mechanism::Wheel::Parameters wheel;
  wheel.stiffness = table.positive("stiffness", kind::stiffness);
  wheel.damping   = table.not_negative("damping", kind::damping, 0.);
  wheel.bilateral = table.boolean("bilateral", false);
  add_element_on(scene, table, checked(table, [&] { return std::make_shared<mechanism::Wheel>(wheel); }), motion);
}

} // namespace gestell::apps
