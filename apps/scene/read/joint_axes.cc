#include "apps/scene/read/joint_axes.h"

#include "fem/values/vector3.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace gestell::apps
{

namespace
{

using fem::dot;

/// Of bodies that can turn about their own axis only.
void check_own_axis(const SceneTable &table, const Names &names, const JointRequest &joint)
{
  const Vector3 axis = table.direction("axis");
  for (const PlaceRequest *place : {&joint.from, &joint.to})
  {
    const BodyRequest *body = names.find_body(place->marker);
    const bool turns = body && (body->kind == coupling::BodyKind::rotor || body->kind == coupling::BodyKind::planar);
    if (turns && std::abs(dot(axis, body->axis)) < 1. - 1e-9)
      throw table.error("axis", "'" + body->name + "' turns about another axis only, its own; leave 'axis' out");
  }
}

/// Of two bodies that turn about their own axis only.
void check_one_axis(const SceneTable &table, const Names &names, const JointRequest &joint)
{
  const BodyRequest *first = names.find_body(joint.from.marker), *second = names.find_body(joint.to.marker);
  const auto         turns = [](const BodyRequest *body)
  { return body && (body->kind == coupling::BodyKind::rotor || body->kind == coupling::BodyKind::planar); };
  if (!turns(first) || !turns(second))
    return;
  const double cosine = std::abs(dot(first->axis, second->axis));
  if (cosine > 1. - 1e-12) // rounding of unit vectors
    return;
  std::ostringstream text;
  text << "'" << first->name << "' and '" << second->name << "' turn about axes that lie "
       << std::acos(std::min(1., cosine)) * 180. / M_PI
       << " deg apart, but a revolute joint has one; use \"spherical\" where they only meet in a point";
  throw table.error("type", text.str());
}

} // namespace

void read_axes(const SceneTable &table, const Names &names, JointRequest &joint)
{
  const auto one_is = [&](coupling::BodyKind kind)
  {
    for (const PlaceRequest *place : {&joint.from, &joint.to})
      if (const BodyRequest *body = names.find_body(place->marker); body && body->kind == kind)
        return true;
    return false;
  };
  const bool turning = joint.type == JointType::revolute && one_is(coupling::BodyKind::rigid);
  if ((turning || joint.type == JointType::universal) && one_is(coupling::BodyKind::point))
    throw table.error("type", "needs directions on both bodies, but a point has none; use a spherical joint");
  if (joint.type == JointType::universal)
  {
    joint.axis    = table.direction("axis_from");
    joint.axis_to = table.direction("axis_to");
    if (std::abs(dot(joint.axis, joint.axis_to)) > 1e-9)
      throw table.error("axis_to", "must be at right angles to 'axis_from': they are the two bars of the cross");
  }
  else if (turning || joint.type == JointType::cylindrical || joint.type == JointType::prismatic ||
           joint.type == JointType::in_plane)
    joint.axis = table.direction("axis");
  else if (joint.type == JointType::revolute)
  {
    if (table.has("axis"))
      check_own_axis(table, names, joint);
    check_one_axis(table, names, joint);
  }
}

void check_no_skew_axis(const SceneTable &table, const Names &names, const std::string &marker, const Vector3 &axis)
{
  const BodyRequest *body = names.find_body(marker);
  if (!body || (body->kind != coupling::BodyKind::rotor && body->kind != coupling::BodyKind::planar))
    return;
  const double cosine = std::abs(dot(axis, body->axis));
  if (cosine > 1e-9 && cosine < 1. - 1e-9)
    throw table.error("axis", "lies askew to the axis of '" + marker + "', about which alone it turns; give that one");
}

} // namespace gestell::apps
