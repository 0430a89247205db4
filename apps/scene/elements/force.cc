#include "apps/scene/read/read_switches.h"
#include "apps/scene/read/relative_motion.h"

#include <cmath>

namespace gestell::apps
{

/// f(t) = constant + sum amplitude sin(2 pi frequency t + phase) acts on `from` along the direction, on `to` against
/// it.
void read_force(const SceneTable &table, const Names &names, Scene &scene)
{
  const auto  motion = constant_motion(read_load_motion(table, names), names);
  const Kind &kind   = motion.rotation ? kind::torque : kind::force;
  LoadRequest load;
  load.name       = table.name();
  load.u          = motion.u;
  load.force_unit = motion.force_unit();
  load.constant   = table.number("constant", kind, 0.);
  for (const auto &part : table.table_array("harmonics"))
    load.oscillations.push_back({2. * M_PI * part.positive("frequency", kind::frequency),
                                 part.number("amplitude", kind), part.number("phase", kind::angle, 0.)});
  if (!table.has("constant") && !table.has("harmonics"))
    throw table.error("needs 'constant' or 'harmonics'; with neither it would do nothing");
  if (!motion.is_measure())
  {
    scene.loads.push_back(load);
    return;
  }
  const ElementRequest element = element_of(load);
  add_element_on(scene, table, element.element, motion);
  scene.elements.back().levels = element.levels;
}

} // namespace gestell::apps
