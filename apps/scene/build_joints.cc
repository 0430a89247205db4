#include "apps/scene/build_joints.h"

#include "apps/scene/build_measures.h"
#include "apps/scene/joint_equations.h"
#include "apps/scene/quantity.h"
#include "mechanism/joints/joint_friction.h"
#include "mechanism/transmitted_element.h"

namespace gestell::apps
{
namespace
{

using mechanism::IdealJoint;
using mechanism::RelativeMeasure;

/// Friction against the motions that a joint leaves free; it sees the multipliers of its equations.
template <int k>
void attach_friction(coupling::Machine &machine, const Pair &pair, const JointFrictionRequest &request,
                     const std::vector<IdealJoint::Equation> &equations, std::vector<RelativeMeasure> measures)
{
  typename mechanism::JointFriction<k>::Parameters friction{request.law, request.radius, 0, 0, request.length};
  for (const IdealJoint::Equation &equation : equations)
    ++(equation.unit == "N" ? friction.n_forces : friction.n_torques);
  machine.attach_friction(
      std::make_shared<mechanism::TransmittedElement>(pair.first, pair.second, std::move(measures),
                                                      std::make_shared<mechanism::JointFriction<k>>(friction)),
      pair.measures);
}

void add_joint_friction(coupling::Machine &machine, const JointRequest &joint, const Pair &pair,
                        const std::vector<IdealJoint::Equation> &equations)
{
  const auto axis = vector(joint.axis);
  if (joint.type == JointType::prismatic)
    attach_friction<1>(machine, pair, *joint.friction, equations, {seen_from_first(axis)});
  else if (joint.type == JointType::in_plane)
  {
    const auto [e_1, e_2] = coupling::plane_across(joint.axis);
    attach_friction<2>(machine, pair, *joint.friction, equations,
                       {seen_from_first(vector(e_1)), seen_from_first(vector(e_2))});
  }
  else if (pair.in_space())
    attach_friction<1>(machine, pair, *joint.friction, equations, {angle_about(axis)});
  else
  {
    const coupling::Body *body = pair.planar();
    for (const coupling::Body *other : {pair.on_first, pair.on_second})
      if (!body && other && other->kind == coupling::BodyKind::rotor)
        body = other;
    if (!body)
      throw std::invalid_argument("has friction, but neither body is planar or a rotor, whose axis a pin turns about");
    attach_friction<1>(machine, pair, *joint.friction, equations, {rotation_about(pair, vector(body->axis), 1.)});
  }
}

/// What a joint looks like: a bar, a pin; of others only the points where they hold.
void draw_joint(coupling::Machine &machine, const JointRequest &joint, const Pair &pair)
{
  draw_places(machine, joint.from, joint.to);
  if (joint.type == JointType::distance)
    machine.draw_bar({joint.name, placed(machine, joint.from), placed(machine, joint.to)});
  if (joint.type != JointType::revolute && joint.type != JointType::cylindrical)
    return;
  if (joint.type == JointType::cylindrical || pair.in_space())
    machine.draw_pin({placed(machine, joint.from), joint.axis});
  else if (const coupling::Body *body = pair.planar())
    machine.draw_pin({placed(machine, joint.from), body->axis});
}

/// What a switch compares its signal with is told in the unit of the signal.
void check_level(const coupling::Machine &machine, const SwitchRequest &request, const Quantity &level,
                 const std::string &what)
{
  const coupling::Signal signal = machine.signal(request.request.name, request.request.signal);
  if (!level.checked || signal.unit.empty() || signal.unit == "1")
    return;
  const Quantity unit = parse_quantity("1 " + signal.unit, [](const std::string &) { return std::nullopt; });
  if (!equal(unit.dimension, level.dimension))
    throw std::invalid_argument("the signal \"" + request.request.signal + "\" is told in " + signal.unit +
                                ", but the " + what + " is " + describe(level.dimension));
}

} // namespace

void add_joint(coupling::Machine &machine, const JointRequest &joint)
{
  if (joint.type == JointType::measure)
  {
    add_measure_joint(machine, joint);
    return;
  }
  const Pair     pair(machine, joint.from, joint.to);
  const auto     axis = vector(joint.axis);
  JointEquations equations(pair);
  switch (joint.type)
  {
  case JointType::revolute:
    equations.coincide();
    if (pair.in_space()) // a rotor or a planar body has its axis already
      equations.one_axis(axis);
    break;
  case JointType::spherical:
    equations.coincide();
    break;
  case JointType::universal:
    equations.coincide();
    equations.at_right_angles(axis, vector(joint.axis_to), "torque");
    break;
  case JointType::cylindrical:
    equations.on_line(axis, 0.);
    equations.one_axis(axis);
    break;
  case JointType::rigid:
    equations.coincide();
    equations.no_rotation();
    break;
  case JointType::prismatic:
    equations.on_line(axis, std::nullopt);
    equations.no_rotation();
    break;
  case JointType::in_plane:
    equations.in_plane(axis);
    break;
  case JointType::distance:
    equations.distance(joint);
    break;
  case JointType::gear:
    equations.gear(joint.ratio);
    break;
  case JointType::measure:
    break;
  }
  if (equations.list.empty())
    throw std::invalid_argument("holds nothing: neither body can move in the way the joint forbids");
  Pair felt = pair;
  equations.leave_out_idle(felt);
  machine.attach(joint.name, std::make_shared<IdealJoint>(felt.first, felt.second, equations.list, joint.law),
                 felt.measures);
  if (joint.friction)
    add_joint_friction(machine, joint, pair, equations.list);
  draw_joint(machine, joint, pair);
}

void attach_between(coupling::Machine &machine, const ElementRequest &element)
{
  const PairRequest           &request = *element.pair;
  const Pair                   pair(machine, request.from, request.to);
  std::vector<RelativeMeasure> measures;
  const coupling::Body        *planar = pair.planar();
  if (request.about && planar && std::abs(vector(planar->axis).dot(vector(*request.about))) < 1. - 1e-9)
    throw std::invalid_argument("its axis must stand across the plane of \"" + planar->name +
                                "\", which turns about its normal only");
  for (const Vector3 &a : request.along)
    measures.push_back(seen_from_first(vector(a)));
  if (request.about)
    measures.push_back(pair.in_space() ? angle_about(vector(*request.about))
                                       : rotation_about(pair, vector(*request.about), 1.));
  machine.attach(
      element.name,
      std::make_shared<mechanism::TransmittedElement>(pair.first, pair.second, std::move(measures), element.element),
      pair.measures);
  draw_places(machine, request.from, request.to);
  if (request.about)
    machine.draw_pin({placed(machine, request.to), *request.about});
}

void add_switch(coupling::Machine &machine, const SwitchRequest &request)
{
  check_level(machine, request, request.level, "level");
  if (request.hysteresis)
    check_level(machine, request, *request.hysteresis, "hysteresis");
  machine.add_switch(request.request);
}

} // namespace gestell::apps
