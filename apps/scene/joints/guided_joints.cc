// Joints that guide a place along a line or in a plane.

#include "apps/scene/joints/joint_friction.h"
#include "apps/scene/joints/joint_keys.h"

namespace gestell::apps
{
namespace
{

void demand_cylindrical(JointEquations &equations, const JointRequest &joint)
{
  equations.on_line(vector(joint.axis), 0.);
  equations.one_axis(vector(joint.axis));
}

std::vector<RubbingMotion> slide_and_turn(const JointRequest &joint, const Pair &pair)
{
  if (!pair.in_space())
    throw std::invalid_argument(
        "has friction, but neither body is of type \"rigid\"; use one, or a revolute or prismatic joint");
  return {{seen_from_first(vector(joint.axis)), false}, {angle_about(vector(joint.axis)), true}};
}

void demand_prismatic(JointEquations &equations, const JointRequest &joint)
{
  equations.on_line(vector(joint.axis), std::nullopt);
  equations.no_rotation();
}

std::vector<RubbingMotion> slide(const JointRequest &joint, const Pair &)
{
  return {{seen_from_first(vector(joint.axis)), false}};
}

std::vector<RubbingMotion> slide_across(const JointRequest &joint, const Pair &)
{
  const auto [e_1, e_2] = coupling::plane_across(joint.axis);
  return {{seen_from_first(vector(e_1)), false}, {seen_from_first(vector(e_2)), false}};
}

} // namespace

JointType cylindrical_type()
{
  JointType type{"cylindrical",
                 "Keeps `to` on the line through `at` along `axis`, which rotates with `from`; `to` may slide along it "
                 "and rotate about it.",
                 "`fx` ..., `mx` ...",
                 point_joint({axis_key(), joint_friction_key()}),
                 read_one_point,
                 demand_cylindrical};
  type.friction        = {true, true, false, slide_and_turn};
  type.holds_rotations = true;
  type.leaves          = 1;
  type.drawn           = JointType::Drawn::pin;
  return type;
}

JointType prismatic_type()
{
  JointType type{"prismatic",
                 "Keeps `to` on a line along `axis`, which rotates with `from`, and prevents relative rotation.",
                 "`fx` ..., `torque`, or `mx` ...",
                 point_joint({axis_key(), joint_friction_key()}),
                 read_joined_places,
                 demand_prismatic};
  type.friction        = {false, true, true, slide};
  type.holds_rotations = true;
  type.leaves          = 1;
  return type;
}

JointType in_plane_type()
{
  JointType type{"in-plane",
                 "Keeps `to` in the plane with the normal `axis`, which rotates with `from`.",
                 "`force`",
                 point_joint({axis_key("normal of the plane"), joint_friction_key()}),
                 read_joined_places,
                 [](JointEquations &equations, const JointRequest &joint) { equations.in_plane(vector(joint.axis)); }};
  type.friction.motions = slide_across;
  type.leaves           = 2;
  return type;
}

} // namespace gestell::apps
