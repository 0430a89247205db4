#include "apps/scene/build/build_joint_friction.h"

#include "apps/scene/build/build_measures.h"
#include "apps/scene/read/joint_friction_request.h"
#include "mechanism/joints/friction_in_joint.h"
#include "mechanism/joints/joint_friction.h"
#include "mechanism/transmitted_element.h"

#include <stdexcept>

namespace gestell::apps
{
namespace
{

using mechanism::FrictionInJoint;
using mechanism::RelativeMeasure;
using mechanism::TransmittedElement;

template <int k>
void attach_smooth(coupling::MachineModel &machine, const Pair &pair, const JointFrictionRequest &request,
                   const mechanism::JointLoad &load, const std::array<RelativeMeasure, k> &motions,
                   const std::array<double, k> &radii)
{
  using Friction = mechanism::JointFriction<k>;
  const auto law = std::make_shared<Friction>(typename Friction::Parameters{request.smooth, radii, load});
  machine.attach_friction(
      std::make_shared<TransmittedElement>(pair.first, pair.second, std::vector(motions.begin(), motions.end()), law),
      pair.measures);
}

RelativeMeasure spin_about(const mechanism::Vector3d &a)
{
  RelativeMeasure spin;
  spin.form = RelativeMeasure::Form::spin;
  spin.a    = a;
  return spin;
}

/// Rotation of the second body against the first: of a pin about `axis`.
RelativeMeasure rotation_of(const Pair &pair, const mechanism::Vector3d &axis)
{
  if (pair.in_space())
    return angle_about(axis);
  const coupling::Body *body = pair.planar();
  for (const coupling::Body *other : {pair.on_first, pair.on_second})
    if (!body && other && other->kind == coupling::BodyKind::rotor)
      body = other;
  if (!body)
    throw std::invalid_argument("has friction, but neither body is planar or a rotor, whose axis a pin turns about");
  return rotation_about(pair, vector(body->axis), 1.);
}

bool turns_far(const coupling::Body *body)
{
  return body && (body->kind == coupling::BodyKind::rotor || body->kind == coupling::BodyKind::planar ||
                  body->kind == coupling::BodyKind::rigid);
}

/// A motion that can be held: its gradient does not change, so that it is one measure of the machine.
coupling::Measure constant_motion(const JointRequest &joint, const Pair &pair, const RelativeMeasure &motion)
{
  using coupling::operator+, coupling::operator*; // a Measure is a plain vector, so the namespace does not tell
  const bool constant =
      joint.type == JointType::revolute ? !pair.in_space() : !turns_far(pair.on_first) || !turns_far(pair.on_second);
  if (!constant)
    throw std::invalid_argument(
        joint.type == JointType::revolute
            ? "has friction of law \"dry\", which can hold planar bodies and rotors, but not a body that turns "
              "freely in space; use \"lugre\", or \"smooth\""
            : "has friction of law \"dry\", which can hold a slide on what does not turn, but here both bodies turn; "
              "use \"lugre\", or \"smooth\"");
  const double      zero[mechanism::PlacedMeasure::max_measures] = {};
  double            gradient[mechanism::PlacedMeasure::max_measures];
  coupling::Measure u;
  mechanism::PlacedMeasure{pair.first, pair.second, motion}.evaluate(zero, zero, gradient);
  for (std::size_t i = 0; i < pair.measures.size(); ++i)
    u = u + gradient[i] * pair.measures[i];
  return u;
}

} // namespace

void add_joint_friction(coupling::MachineModel &machine, const JointRequest &joint, const Pair &pair,
                        const std::vector<mechanism::IdealJoint::Equation> &equations)
{
  const JointFrictionRequest &friction = *joint.friction;
  const auto                  axis     = vector(joint.axis);
  const double                r        = friction.radius;
  mechanism::JointLoad        load{0, 0, friction.length};
  for (const mechanism::IdealJoint::Equation &equation : equations)
    ++(equation.unit == "N" ? load.n_forces : load.n_torques);
  if (joint.type == JointType::in_plane)
  {
    const auto [e_1, e_2] = coupling::plane_across(joint.axis);
    attach_smooth<2>(machine, pair, friction, load, {seen_from_first(vector(e_1)), seen_from_first(vector(e_2))}, {});
    return;
  }
  if (joint.type != JointType::prismatic && pair.has_point())
    throw std::invalid_argument("has friction, but one body is a point, which has no rotation that could rub");
  if (joint.type == JointType::cylindrical)
  {
    if (!pair.in_space())
      throw std::invalid_argument("has friction, but neither body is rigid; a pin that turns and slides needs one, "
                                  "others a revolute or prismatic joint");
    attach_smooth<2>(machine, pair, friction, load, {seen_from_first(axis), angle_about(axis)}, {0., r});
    return;
  }
  if (joint.type == JointType::spherical && pair.in_space())
  {
    attach_smooth<3>(machine, pair, friction, load,
                     {spin_about(mechanism::Vector3d::UnitX()), spin_about(mechanism::Vector3d::UnitY()),
                      spin_about(mechanism::Vector3d::UnitZ())},
                     {r, r, r});
    return;
  }
  const RelativeMeasure motion = joint.type == JointType::prismatic ? seen_from_first(axis) : rotation_of(pair, axis);
  if (friction.dry)
    machine.attach_friction(std::make_shared<FrictionInJoint<mechanism::CoulombFriction>>(*friction.dry, load, r),
                            {constant_motion(joint, pair, motion)});
  else if (friction.bristles)
  {
    const auto law      = std::make_shared<FrictionInJoint<mechanism::LuGreFriction>>(*friction.bristles, load, r);
    auto       measures = pair.measures;
    measures.push_back({{machine.add_lag(joint.name + ".bristles", mechanism::LuGreFriction::lag()), 1.}});
    machine.attach_friction(
        std::make_shared<TransmittedElement>(mechanism::PlacedMeasure{pair.first, pair.second, motion}, law), measures);
  }
  else
    attach_smooth<1>(machine, pair, friction, load, {motion}, {r});
}

} // namespace gestell::apps
