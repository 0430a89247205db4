#include "mechanism/elements/rope.h"

#include "apps/scene/read/checked.h"
#include "apps/scene/read/relative_motion.h"

namespace gestell::apps
{

/// Taut where `from` is further along the direction than `to` by more than the slack.
void read_rope(const SceneTable &table, const Names &names, Scene &scene)
{
  const auto                  motion = read_relative_motion(table, names);
  const bool                  turns  = motion.rotation;
  mechanism::Rope::Parameters rope;
  rope.stiffness = table.positive("stiffness", turns ? kind::torsional_stiffness : kind::stiffness);
  rope.damping   = table.not_negative("damping", turns ? kind::torsional_damping : kind::damping, rope.damping);
  rope.slack     = table.number("slack", turns ? kind::angle : kind::length, rope.slack);
  add_element_on(scene, table, checked(table, [&] { return std::make_shared<mechanism::Rope>(rope); }), motion);
}

} // namespace gestell::apps
