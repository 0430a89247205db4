// Motions that follow a function: of another motion, or of time.

#include "apps/scene/joints/joint_types.h"
#include "apps/scene/read/read_function.h"
#include "apps/scene/read/read_motion.h"
#include "apps/scene/read/read_scalars.h"

namespace gestell::apps
{
namespace
{

std::vector<Key> cam_keys()
{
  return joined({{key::named("from", "input: a measure or coordinate, [see there](#places-and-measures)"),
                  key::named("to", "follower: a measure or coordinate")},
                 position_function_keys()});
}

void read_cam(const SceneTable &table, const Names &names, JointRequest &joint)
{
  ScalarRequest x;
  joint.measure = read_position_function(table, names, x);
  refuse_jumps(table, *joint.measure.function, x.kind());
  joint.value         = 0.;
  joint.reaction_unit = x.unit == "rad" ? "N m" : "N";
}

void read_prescribed_motion(const SceneTable &table, const Names &names, JointRequest &joint)
{
  const auto on       = read_scalar(table, "on", names);
  const bool turns    = on.unit == "rad";
  joint.measure.terms = {on.term};
  joint.measure.unit  = on.unit;
  joint.law           = read_motion(table.table("motion"), turns);
  table.fill(joint, turns);
}

} // namespace

JointType position_function_type()
{
  return {"position function", "`to` = f(`from`): cams, indexing drives.",
          "`force` or `torque` on `to`, `reaction` on `from`", cam_keys(), read_cam};
}

MeasureType position_function_measure()
{
  return {"position function", "`to` - f(`from`): distance of the follower `to` from its cam.",
          "`value`, `rate`, `acceleration`", cam_keys(),
          [](const SceneTable &table, const Names &names)
          {
            ScalarRequest x;
            return read_position_function(table, names, x);
          }};
}

JointType prescribed_motion_type()
{
  return {"prescribed motion",
          "`on` = `initial` + f(t).",
          "`force` or `torque`, and the `power` supplied",
          {key::named("on", "[a measure or coordinate](#places-and-measures)"),
           key::table("motion", motion_law_keys(), "function of time f(t)"),
           key::number("initial", kind::length, "value at the start")
               .on_angle(kind::angle)
               .by_default("that of the reference configuration")
               .into(&JointRequest::value)},
          read_prescribed_motion};
}

} // namespace gestell::apps
