#include "mechanism/elements/rope.h"

#include "apps/scene/elements/element_types.h"
#include "apps/scene/read/relative_motion.h"

namespace gestell::apps
{

/// Taut where `from` is further along the direction than `to` by more than the slack.
void read_rope(const SceneTable &table, const Names &names, Scene &scene)
{
  const auto                  motion = read_relative_motion(table, names);
  const bool                  turns  = motion.rotation;
  mechanism::Rope::Parameters rope;
  rope.stiffness = table.value("stiffness", turns);
  rope.damping   = table.value("damping", turns);
  rope.slack     = table.value("slack", turns);
  add_law<mechanism::Rope>(scene, table, rope, motion);
}

ElementType rope_type()
{
  const mechanism::Rope::Parameters own;
  return {
      "rope",
      "Pulls where u > slack, never pushes.",
      "`force`, `elongation`",
      joined(
          {motion_keys(),
           {key::number("stiffness", kind::stiffness, "of the rope").on_angle(kind::torsional_stiffness).above_zero(),
            key::number("damping", kind::damping, "while it is taut")
                .on_angle(kind::torsional_damping)
                .from_zero()
                .by_default(own.damping),
            key::number("slack", kind::length, "u at which it becomes taut; negative: taut at u = 0")
                .on_angle(kind::angle)
                .by_default(own.slack)}}),
      read_rope,
      {R"toml(from      = "slide"                  # never pushes
stiffness = "900 N/mm"
damping   = "2 kN s/m"
slack     = "5 mm"
)toml"}};
}

} // namespace gestell::apps
