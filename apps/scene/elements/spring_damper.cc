#include "mechanism/elements/spring_damper.h"

#include "apps/scene/read/relative_motion.h"

namespace gestell::apps
{

/// F = preload + c (u - rest) + b u' acts on `to` along the direction, on `from` against it; on a measure against its
/// growth.
void read_spring_damper(const SceneTable &table, const Names &names, Scene &scene)
{
  const auto   motion    = read_relative_motion(table, names);
  const bool   turns     = motion.rotation;
  const double stiffness = table.not_negative("stiffness", turns ? kind::torsional_stiffness : kind::stiffness, 0.);
  const double damping   = table.not_negative("damping", turns ? kind::torsional_damping : kind::damping, 0.);
  const double preload   = table.number("preload", turns ? kind::torque : kind::force, 0.);
  const double rest      = table.number("rest", turns ? kind::angle : kind::length, 0.);
  // A value may be varied down to zero; what is not given at all was forgotten.
  if (!table.has("stiffness") && !table.has("damping") && !table.has("preload"))
    throw table.error("needs 'stiffness', 'damping' or 'preload'; with none of them it would do nothing");
  if (!motion.is_measure())
    scene.linear.push_back({table.name(), motion.u, stiffness, damping, preload, rest, motion.force_unit()});
  else
    add_element_on(scene, table,
                   std::make_shared<mechanism::SpringDamper>(
                       mechanism::SpringDamper::Parameters{stiffness, damping, preload, rest}),
                   motion);
}

} // namespace gestell::apps
