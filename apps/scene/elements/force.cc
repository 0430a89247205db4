#include "apps/scene/elements/element_types.h"
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
  LoadRequest load;
  load.name       = table.name();
  load.u          = motion.u;
  load.force_unit = motion.force_unit();
  table.fill(load, motion.rotation);
  for (const auto &part : table.table_array("harmonics"))
    load.oscillations.push_back(
        {2. * M_PI * part.value("frequency"), part.value("amplitude", motion.rotation), part.value("phase")});
  if (!table.has("constant") && !table.has("harmonics"))
    throw table.error("needs 'constant' or 'harmonics'; without both it has no effect");
  if (!motion.is_measure())
  {
    scene.loads.push_back(load);
    return;
  }
  const ElementRequest element = element_of(load);
  add_element_on(scene, table, element.element, motion);
  scene.elements.back().levels = element.levels;
}

ElementType force_type()
{
  return {
      "force",
      "Force f = constant + sum of amplitude sin(2 pi frequency t + phase), acting on `from` along the direction and "
      "on `to` in the opposite direction.",
      "`force` (or `torque`)",
      joined({load_motion_keys(),
              {key::number("constant", kind::force, "constant part of the force")
                   .on_angle(kind::torque)
                   .by_default(&LoadRequest::constant),
               key::composed("harmonics", Key::Form::tables, kind::force,
                             {key::number("amplitude", kind::force, "amplitude of the harmonic").on_angle(kind::torque),
                              key::number("frequency", kind::frequency, "frequency of the harmonic").above_zero(),
                              key::number("phase", kind::angle, "phase of the harmonic").by_default(0.)},
                             "harmonic parts of the force")
                   .by_default("none")}}),
      read_force,
      {R"toml(from      = "slide"
constant  = "30 N"
harmonics = [{ amplitude = "600 N", frequency = "4 Hz", phase = "30 deg" }]
)toml",
       R"toml(from       = "lance"                 # turns with the lance, and turns it
at_from    = ["0.9 m", 0, 0]
direction  = [0, 0, 1]
carried_by = "lance"
constant   = "30 N"
)toml"}};
}

} // namespace gestell::apps
