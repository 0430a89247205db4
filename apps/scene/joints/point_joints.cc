// Joints that connect two bodies in a point.

#include "apps/scene/joints/joint_friction.h"
#include "apps/scene/joints/joint_keys.h"
#include "fem/values/vector3.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace gestell::apps
{
namespace
{

using fem::dot;
using mechanism::Vector3d;

/// Whether one of the two is of that kind.
bool one_is(coupling::BodyKind kind, const Names &names, const JointRequest &joint)
{
  const auto is = [&](const PlaceRequest &place)
  {
    const BodyRequest *body = names.find_body(place.marker);
    return body && body->kind == kind;
  };
  return is(joint.from) || is(joint.to);
}

/// Joints of axes on both bodies.
void refuse_points(const SceneTable &table, const Names &names, const JointRequest &joint)
{
  if (one_is(coupling::BodyKind::point, names, joint))
    throw table.error("type", "needs directions on both bodies, but a point has none; use a spherical joint");
}

/// For bodies that can rotate only about their own axis.
void check_own_axis(const SceneTable &table, const Names &names, const JointRequest &joint)
{
  const Vector3 axis = table.direction("axis");
  for (const PlaceRequest *place : {&joint.from, &joint.to})
  {
    const BodyRequest *body = names.find_body(place->marker);
    if (turns_about_own_axis(body) && std::abs(dot(axis, body->axis)) < 1. - 1e-9)
      throw table.error("axis", "'" + body->name + "' rotates about its own axis only; remove 'axis'");
  }
}

/// For two bodies that can rotate only about their own axis.
void check_one_axis(const SceneTable &table, const Names &names, const JointRequest &joint)
{
  const BodyRequest *first = names.find_body(joint.from.marker), *second = names.find_body(joint.to.marker);
  if (!turns_about_own_axis(first) || !turns_about_own_axis(second))
    return;
  const double cosine = std::abs(dot(first->axis, second->axis));
  if (cosine > 1. - 1e-12) // rounding of unit vectors
    return;
  std::ostringstream text;
  text << "'" << first->name << "' and '" << second->name << "' rotate about axes that are "
       << std::acos(std::min(1., cosine)) * 180. / M_PI
       << " deg apart, but a revolute joint has one axis; use \"spherical\" if they only share a point";
  throw table.error("type", text.str());
}

void read_revolute(const SceneTable &table, const Names &names, JointRequest &joint)
{
  read_one_point(table, names, joint);
  joint.holds_rotations = one_is(coupling::BodyKind::rigid, names, joint);
  if (joint.holds_rotations)
  {
    refuse_points(table, names, joint);
    joint.axis = table.direction("axis");
    return;
  }
  if (table.has("axis"))
    check_own_axis(table, names, joint);
  check_one_axis(table, names, joint);
}

/// A rotor or a planar body has its axis already.
void demand_revolute(JointEquations &equations, const JointRequest &joint)
{
  equations.coincide();
  if (equations.pair().in_space())
    equations.one_axis(vector(joint.axis));
}

std::vector<RubbingMotion> rotations(const JointRequest &, const Pair &pair)
{
  if (!pair.in_space())
    return {{rotation_of_pin(pair, Vector3d::Zero()), true}};
  std::vector<RubbingMotion> spins(3, {{}, true});
  for (int d = 0; d < 3; ++d)
  {
    spins[d].motion.form = mechanism::RelativeMeasure::Form::spin;
    spins[d].motion.a    = Vector3d::Unit(d);
  }
  return spins;
}

void read_universal(const SceneTable &table, const Names &names, JointRequest &joint)
{
  read_one_point(table, names, joint);
  refuse_points(table, names, joint);
  if (std::abs(fem::dot(joint.axis, joint.axis_to)) > 1e-9)
    throw table.error("axis_to", "must be perpendicular to 'axis_from', because both are axes of the cross");
}

void demand_universal(JointEquations &equations, const JointRequest &joint)
{
  equations.coincide();
  equations.at_right_angles(vector(joint.axis), vector(joint.axis_to), "torque");
}

void demand_rigid(JointEquations &equations, const JointRequest &)
{
  equations.coincide();
  equations.no_rotation();
}

} // namespace

JointType revolute_type()
{
  JointType type{
      "revolute",
      "Pin: the point `at` of both bodies coincides (for a planar body on a frame, within its plane). Rotors and "
      "planar bodies must rotate about parallel axes. A rigid body needs `axis`, which is also constrained; for others "
      "it is optional.",
      "`fx`, `fy`, `fz`; for a rigid body also `mx` ...",
      point_joint(
          {key::direction("axis", "axis of rotation").by_default("that of the bodies; required for a rigid body"),
           joint_friction_key()}),
      read_revolute,
      demand_revolute};
  type.drawn            = JointType::Drawn::pin;
  type.friction.turns   = true;
  type.friction.sticks  = true;
  type.friction.motions = [](const JointRequest &joint, const Pair &pair) {
    return std::vector<RubbingMotion>{{rotation_of_pin(pair, vector(joint.axis)), true}};
  };
  return type;
}

JointType spherical_type()
{
  JointType type{"spherical",        "Ball joint: the point `at` of both bodies coincides.",
                 "`fx`, `fy`, `fz`", point_joint({joint_friction_key()}),
                 read_one_point,     [](JointEquations &equations, const JointRequest &) { equations.coincide(); }};
  type.friction.turns   = true;
  type.friction.motions = rotations;
  return type;
}

JointType universal_type()
{
  JointType type{
      "universal",
      "Universal joint: the point `at` of both bodies coincides, and two axes, one on each body, stay perpendicular.",
      "`fx` ..., `torque`",
      point_joint({key::direction("axis_from", "axis on `from`").into(&JointRequest::axis),
                   key::direction("axis_to", "axis on `to`").into(&JointRequest::axis_to)}),
      read_universal,
      demand_universal};
  type.holds_rotations = true;
  return type;
}

JointType rigid_type()
{
  JointType type{"rigid",
                 "Rigid connection at the point `at`: no relative displacement, no relative rotation.",
                 "`fx` ..., `torque`, or `mx` ...",
                 point_joint({}),
                 read_one_point,
                 demand_rigid};
  type.holds_rotations = true;
  return type;
}

} // namespace gestell::apps
