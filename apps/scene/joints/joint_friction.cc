#include "apps/scene/joints/joint_friction.h"

#include "apps/scene/read/read_contact.h"
#include "mechanism/joints/friction_in_joint.h"
#include "mechanism/joints/joint_friction.h"
#include "mechanism/transmitted_element.h"

#include <stdexcept>

namespace gestell::apps
{
namespace
{

const Kind bristles_per_metre{"stiffness of the bristles per unit of the normal force", "20 1/mm", {-1, 0, 0}};
const Kind bristle_damping{"damping of the bristles per unit of the normal force", "3 s/m", {-1, 0, 1}};

/// Coefficients of both laws that stick, on the surface.
template <class Friction>
void read_coefficients(const SceneTable &own, Friction &friction)
{
  friction.kinetic_force     = own.value("coefficient");
  friction.static_force      = own.value_or("static", friction.kinetic_force);
  friction.stribeck_speed    = own.value_or("stribeck_speed", 0.);
  friction.stribeck_exponent = own.value_or("stribeck_exponent", friction.stribeck_exponent);
  if (friction.static_force < friction.kinetic_force)
    throw own.error("static", "is below 'coefficient'; static friction must be at least the kinetic one");
}

mechanism::LuGreFriction::Parameters read_bristles(const SceneTable &own)
{
  mechanism::LuGreFriction::Parameters friction;
  read_coefficients(own, friction);
  if (friction.kinetic_force == 0.)
    throw own.error("coefficient", "must be positive; without friction, remove this table");
  friction.bristle_stiffness = own.value("bristle_stiffness");
  friction.bristle_damping   = own.value("bristle_damping");
  if (friction.static_force > friction.kinetic_force && friction.stribeck_speed == 0.)
    throw own.error(
        "needs 'stribeck_speed', the speed over which the coefficient falls from static to kinetic friction");
  return friction;
}

} // namespace

Key joint_friction_key()
{
  std::vector<Key> keys = sliding_friction_key().keys;
  for (Key &key : keys)
    if (key.name == "stribeck_exponent")
      key = key.by_default("1; for `\"lugre\"` 2");
  return key::composed(
             "friction", Key::Form::coefficient, kind::number,
             joined({{key::choice("law", {"smooth", "dry", "lugre"}, true, "behaviour near rest")},
                     keys,
                     {key::number("bristle_stiffness", bristles_per_metre, "bristle stiffness for `\"lugre\"`")
                          .above_zero()
                          .by_default("required for `\"lugre\"`"),
                      key::number("bristle_damping", bristle_damping, "bristle damping for `\"lugre\"`")
                          .from_zero()
                          .by_default(0.),
                      key::number("radius", kind::length, "radius of the pin or the ball")
                          .above_zero()
                          .by_default("required for joints that rotate"),
                      key::number("length", kind::length,
                                  "length of the guide of a prismatic or cylindrical joint: torques are carried by "
                                  "forces at its ends, which also cause friction")
                          .above_zero()
                          .by_default("torques cause no friction")}}),
             "friction due to the joint force, [see there](#friction-in-joints)")
      .from_zero()
      .by_default("none");
}

std::shared_ptr<const JointFrictionRequest> read_joint_friction(const SceneTable &any, const JointType &type)
{
  static const std::vector<Key> keys  = {joint_friction_key()};
  const SceneTable              table = any.declared(keys);
  if (!table.has("friction"))
    return nullptr;
  const FrictionForm &form = type.friction;
  if (!form.motions)
    throw table.error("friction", "is for joints of type \"revolute\", \"prismatic\", \"cylindrical\", \"spherical\" "
                                  "and \"in-plane\"; for others add an element of type \"friction\" to the joint");
  if (form.turns && !table.is_table("friction"))
    throw table.error("friction", "needs the radius of the surface that slides; write { coefficient = 0.1, radius = "
                                  "\"20 mm\" }");
  JointFrictionRequest friction;
  const auto           own = table.is_table("friction") ? table.optional_table("friction") : std::nullopt;
  const std::string    law = own ? own->choice("law") : "smooth";
  if (law != "smooth" && !form.sticks)
    throw own->error(
        "law",
        "is \"" + law +
            "\", which is for revolute and prismatic joints only; remove it: \"smooth\" creeps instead of sticking");
  if (law == "dry")
    read_coefficients(*own, friction.dry.emplace());
  else if (law == "lugre")
    friction.bristles = read_bristles(*own);
  else
    friction.smooth = read_sliding_friction(any);
  if (form.turns)
    friction.radius = own->value("radius");
  if (form.guided && own)
    friction.length = own->value_or("length", 0.);
  return std::make_shared<JointFrictionRequest>(friction);
}

RelativeMeasure rotation_of_pin(const Pair &pair, const mechanism::Vector3d &axis)
{
  if (pair.in_space())
    return angle_about(axis);
  const coupling::Body *body = pair.planar();
  for (const coupling::Body *other : {pair.on_first, pair.on_second})
    if (!body && other && other->kind == coupling::BodyKind::rotor)
      body = other;
  if (!body)
    throw std::invalid_argument("has friction, but neither body is a planar body or a rotor");
  return rotation_about(pair, vector(body->axis), 1.);
}

namespace
{

using mechanism::FrictionInJoint;
using mechanism::RelativeMeasure;
using mechanism::TransmittedElement;

template <int k>
void attach_smooth(coupling::MachineModel &machine, const Pair &pair, const JointFrictionRequest &request,
                   const mechanism::JointLoad &load, const std::vector<RubbingMotion> &rubbing)
{
  using Friction = mechanism::JointFriction<k>;
  std::array<double, k>        radii;
  std::vector<RelativeMeasure> motions;
  for (int i = 0; i < k; ++i)
  {
    radii[i] = rubbing[i].turns ? request.radius : 0.;
    motions.push_back(rubbing[i].motion);
  }
  const auto law = std::make_shared<Friction>(typename Friction::Parameters{request.smooth, radii, load});
  machine.attach_friction(std::make_shared<TransmittedElement>(pair.first, pair.second, motions, law), pair.measures);
}

bool turns_far(const coupling::Body *body)
{
  return body && (body->kind == coupling::BodyKind::rotor || body->kind == coupling::BodyKind::planar ||
                  body->kind == coupling::BodyKind::rigid);
}

/// The motion as a single measure of the machine, for friction that can stick: its gradient must be constant.
coupling::Measure constant_motion(const Pair &pair, const RubbingMotion &rubbing)
{
  using coupling::operator+, coupling::operator*; // a Measure is a plain vector, so the namespace does not tell
  const bool constant = rubbing.turns ? !pair.in_space() : !turns_far(pair.on_first) || !turns_far(pair.on_second);
  if (!constant)
    throw std::invalid_argument(
        rubbing.turns
            ? "has friction of law \"dry\", which is not possible for a free spatial body; use \"lugre\" or \"smooth\""
            : "has friction of law \"dry\", which needs a body that does not rotate, "
              "but here both bodies rotate; use \"lugre\", or \"smooth\"");
  const double      zero[mechanism::PlacedMeasure::max_measures] = {};
  double            gradient[mechanism::PlacedMeasure::max_measures];
  coupling::Measure u;
  mechanism::PlacedMeasure{pair.first, pair.second, rubbing.motion}.evaluate(zero, zero, gradient);
  for (std::size_t i = 0; i < pair.measures.size(); ++i)
    u = u + gradient[i] * pair.measures[i];
  return u;
}

} // namespace

void add_joint_friction(coupling::MachineModel &machine, const JointRequest &joint, const FrictionForm &form,
                        const Pair &pair, const std::vector<mechanism::IdealJoint::Equation> &equations)
{
  const JointFrictionRequest &friction = *joint.friction;
  const double                r        = friction.radius;
  mechanism::JointLoad        load{0, 0, friction.length};
  for (const mechanism::IdealJoint::Equation &equation : equations)
    ++(equation.unit == "N" ? load.n_forces : load.n_torques);
  if (form.turns && pair.has_point())
    throw std::invalid_argument("has friction, but one body is a point, which has no rotation");
  const std::vector<RubbingMotion> motions = form.motions(joint, pair);
  if (friction.dry)
    machine.attach_friction(std::make_shared<FrictionInJoint<mechanism::CoulombFriction>>(*friction.dry, load, r),
                            {constant_motion(pair, motions[0])});
  else if (friction.bristles)
  {
    const auto law      = std::make_shared<FrictionInJoint<mechanism::LuGreFriction>>(*friction.bristles, load, r);
    auto       measures = pair.measures;
    measures.push_back({{machine.add_lag(joint.name + ".bristles", mechanism::LuGreFriction::lag()), 1.}});
    machine.attach_friction(
        std::make_shared<TransmittedElement>(mechanism::PlacedMeasure{pair.first, pair.second, motions[0].motion}, law),
        measures);
  }
  else if (motions.size() == 3)
    attach_smooth<3>(machine, pair, friction, load, motions);
  else if (motions.size() == 2)
    attach_smooth<2>(machine, pair, friction, load, motions);
  else
    attach_smooth<1>(machine, pair, friction, load, motions);
}

} // namespace gestell::apps
