// Joints of a way and an angle: along - factor * angle = 0.

#include "apps/scene/joints/joint_keys.h"
#include "apps/scene/joints/joint_type.h"
#include "apps/scene/read/relative_motion.h"
#include "fem/values/vector3.h"

#include <cmath>

namespace gestell::apps
{
namespace
{

using fem::dot;
using Carrier = mechanism::RelativeMeasure::Carrier;

MeasureRequest path(const PlaceRequest &first, const PlaceRequest &second, const Vector3 &direction, Carrier carrier)
{
  MeasureRequest along;
  along.first   = first;
  along.second  = second;
  along.a       = direction;
  along.carrier = carrier;
  return along;
}

void join_path_and_angle(JointRequest &joint, const MeasureRequest &along, double factor, const MotionMeasure &angle)
{
  joint.measure.terms = {{1., {}, std::make_shared<MeasureRequest>(along)}, {-factor, angle, nullptr}};
  joint.measure.unit  = "m";
}

/// A body that rotates about its own axis has no angle about a skew one.
void check_no_skew_axis(const SceneTable &table, const Names &names, const std::string &marker, const Vector3 &axis)
{
  const BodyRequest *body = names.find_body(marker);
  if (!turns_about_own_axis(body))
    return;
  const double cosine = std::abs(fem::dot(axis, body->axis));
  if (cosine > 1e-9 && cosine < 1. - 1e-9)
    throw table.error("axis",
                      "is not parallel to the axis of '" + marker + "', about which it rotates; give that axis");
}

void read_screw(const SceneTable &table, const Names &names, JointRequest &joint)
{
  read_two_places(table, names, joint);
  refuse_in_space(table, "from", joint.from.marker, names);
  refuse_in_space(table, "to", joint.to.marker, names);
  for (const PlaceRequest *place : {&joint.from, &joint.to})
    check_no_skew_axis(table, names, place->marker, joint.axis);
  const double pitch = table.value("pitch");
  if (pitch == 0.)
    throw table.error("pitch", "is zero; give the advance per revolution, negative for a left-handed thread");
  join_path_and_angle(joint, path(joint.from, joint.to, joint.axis, mechanism::RelativeMeasure::Carrier::first),
                      pitch / (2. * M_PI), difference(joint.to.marker, joint.from.marker, joint.axis, true));
}

/// Whether a body or what carries it may move along a direction.
bool moves_along(const Names &names, const std::string &marker, const Vector3 &direction)
{
  using coupling::BodyKind;
  const BodyRequest *body = names.find_body(marker);
  if (!body)
    return marker != "ground";
  if (body->kind == BodyKind::planar)
    return std::abs(std::abs(dot(body->axis, direction)) - 1.) > 1e-9;
  if (body->kind == BodyKind::slider && std::abs(dot(body->axis, direction)) > 1e-9)
    return true;
  const bool carried = body->kind == BodyKind::slider || body->kind == BodyKind::rotor;
  return !carried || body->carrier != "ground";
}

/// @param way_out  where neither can move
/// @return angle of the wheel `from` against `to`, whose way is radius times it along `joint.axis`
MotionMeasure read_wheel_and_way(const SceneTable &table, const Names &names, JointRequest &joint,
                                 const std::string &way_out)
{
  read_two_places(table, names, joint);
  refuse_in_space(table, "to", joint.to.marker, names);
  const BodyRequest *wheel = names.find_body(joint.from.marker);
  if (!turns_about_own_axis(wheel))
    throw table.error("from", "'" + joint.from.marker +
                                  "' is not a rotor or planar body; this joint needs one that rotates about its axis");
  if (std::abs(dot(joint.axis, wheel->axis)) > 1e-9)
    throw table.error("direction", "must be perpendicular to the axis of '" + joint.from.marker + "'");
  if (!moves_along(names, joint.from.marker, joint.axis) && !moves_along(names, joint.to.marker, joint.axis))
    throw table.error("direction", "neither '" + joint.from.marker + "' nor '" + joint.to.marker +
                                       "' can move along it, so the wheel could not rotate; " + way_out);
  return difference(joint.from.marker, joint.to.marker, wheel->axis, true);
}

void read_rolling(const SceneTable &table, const Names &names, JointRequest &joint)
{
  const auto angle = read_wheel_and_way(table, names, joint, "make the wheel a planar body, or let its carrier move");
  join_path_and_angle(joint, path(joint.to, joint.from, joint.axis, Carrier::first), table.value("radius"), angle);
}

void read_rack(const SceneTable &table, const Names &names, JointRequest &joint)
{
  const auto angle = read_wheel_and_way(table, names, joint, "give the direction of the rack");
  join_path_and_angle(joint, path(joint.from, joint.to, joint.axis, Carrier::second), table.value("radius"), angle);
}

std::vector<Key> rolling_keys(const std::vector<Key> &places)
{
  return joined({places,
                 {key::number("radius", kind::length, "radius of the wheel").above_zero(),
                  key::direction("direction", "direction of the path, perpendicular to the axis of the wheel")
                      .into(&JointRequest::axis)}});
}

} // namespace

JointType screw_type()
{
  return {"screw",
          "Screw: `to` advances along `axis`, which rotates with `from`, by `pitch` per revolution relative to `from`.",
          "`force` on `to`",
          joined({two_places(),
                  {axis_key(),
                   key::number("pitch", kind::length, "advance per revolution; negative for a left-handed thread")}}),
          read_screw};
}

JointType rolling_type()
{
  return {"rolling",
          "Rolling without slip: the wheel `from`, a rotor or planar body, moves along `direction` of `to` by `radius` "
          "times its angle. `at_to` is a point of its path. Another joint (`\"in-plane\"` through its centre) or a "
          "contact keeps it on the path.",
          "`force` on `from`", rolling_keys(place_on_ground()), read_rolling};
}

JointType rack_type()
{
  return {"rack",
          "Rack: `to` moves along `direction`, which rotates with it, by `radius` times the angle of `from`, a rotor "
          "or planar body.",
          "`force` on `to`", rolling_keys(two_places()), read_rack};
}

} // namespace gestell::apps
