#include "apps/scene/joints/joint_keys.h"
#include "apps/scene/joints/joint_type.h"
#include "apps/scene/read/read_motion.h"

namespace gestell::apps
{

static void read_distance(const SceneTable &table, const Names &names, JointRequest &joint)
{
  static const std::vector<Key> of_one_point = one_point();
  if (table.declared(of_one_point).has("at"))
    throw table.error("at", "is one point, but a distance needs two; give 'at_from' and 'at_to'");
  read_two_places(table, names, joint);
  if (const auto motion = table.optional_table("motion"))
    joint.law = read_motion(*motion, false);
}

JointType distance_type()
{
  JointType type{
      "distance",
      "Constrains the distance of two points: a massless rod, a taut rope, a cylinder.",
      "`force`, positive if it pushes the points apart",
      joined({two_places(),
              {key::number("length", kind::length, "distance")
                   .above_zero()
                   .by_default("that of the reference configuration")
                   .into(&JointRequest::length),
               key::table("motion", motion_law_keys(), "growth of the distance over time, starting at `length`")
                   .by_default("none")}}),
      read_distance,
      [](JointEquations &equations, const JointRequest &joint) { equations.distance(joint); }};
  type.drawn = JointType::Drawn::bar;
  return type;
}

} // namespace gestell::apps
