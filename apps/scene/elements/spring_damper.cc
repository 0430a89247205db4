#include "apps/scene/relative_motion.h"

namespace gestell::apps
{

/// F = preload + c (u - rest) + b u' acts on `to` along the direction, on `from` against it.
void read_spring_damper(const SceneTable &table, const Names &names, Scene &scene)
{
  const auto    motion = read_relative_motion(table, names);
  const bool    turns  = motion.rotation;
  LinearRequest spring;
  spring.name       = table.name();
  spring.u          = motion.u;
  spring.force_unit = motion.force_unit();
  spring.stiffness  = table.not_negative("stiffness", turns ? kind::torsional_stiffness : kind::stiffness, 0.);
  spring.damping    = table.not_negative("damping", turns ? kind::torsional_damping : kind::damping, 0.);
  spring.preload    = table.number("preload", turns ? kind::torque : kind::force, 0.);
  spring.rest       = table.number("rest", turns ? kind::angle : kind::length, 0.);
  // A value may be varied down to zero; what is not given at all was forgotten.
  if (!table.has("stiffness") && !table.has("damping") && !table.has("preload"))
    throw table.error("needs 'stiffness', 'damping' or 'preload'; with none of them it would do nothing");
  scene.linear.push_back(spring);
}

} // namespace gestell::apps
