#include "apps/scene/build_joints.h"

#include "apps/scene/build_measures.h"
#include "apps/scene/quantity.h"
#include "mechanism/joints/ideal_joint.h"
#include "mechanism/joints/joint_friction.h"
#include "mechanism/transmitted_element.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{
namespace
{

using coupling::Body;
using coupling::BodyKind;
using mechanism::IdealJoint;
using mechanism::PlacedMeasure;
using mechanism::Placement;
using mechanism::RelativeMeasure;
using mechanism::Vector3d;
using Form = RelativeMeasure::Form;

constexpr double immobile = 1e-12; ///< gradient of an equation that no motion of the two bodies changes

/// Two places with the measures of both.
struct Pair
{
  Pair(const coupling::Machine &machine, const PlaceRequest &from, const PlaceRequest &to)
  {
    const auto a = placed(machine, from), b = placed(machine, to);
    first    = a.placement;
    second   = b.placement;
    measures = a.measures;
    measures.insert(measures.end(), b.measures.begin(), b.measures.end());
    for (const Body &body : machine.bodies())
    {
      if (body.name == from.marker)
        on_first = &body;
      if (body.name == to.marker)
        on_second = &body;
    }
  }

  const Body *planar() const
  {
    for (const Body *body : {on_first, on_second})
      if (body && body->kind == BodyKind::planar)
        return body;
    return nullptr;
  }

  double at_start(const RelativeMeasure &measure, double &largest_gradient) const
  {
    const double zero[PlacedMeasure::max_measures] = {};
    double       gradient[PlacedMeasure::max_measures];
    const auto   value = PlacedMeasure{first, second, measure}.evaluate(zero, zero, gradient);
    largest_gradient   = 0.;
    for (std::size_t i = 0; i < measures.size(); ++i)
      largest_gradient = std::max(largest_gradient, std::abs(gradient[i]));
    return value.s;
  }

  Placement                      first, second;
  std::vector<coupling::Measure> measures;
  const Body                    *on_first = nullptr, *on_second = nullptr;
};

/// Rotation of body 2 about a, less `factor` times that of body 1.
RelativeMeasure rotation_about(const Pair &pair, const Vector3d &a, double factor)
{
  RelativeMeasure rotation;
  rotation.form = Form::ratio;
  for (int i = 0; i < pair.first.n_measures(); ++i)
    rotation.ratios.push_back(-factor * pair.first.rotation(i).dot(a));
  for (int i = 0; i < pair.second.n_measures(); ++i)
    rotation.ratios.push_back(pair.second.rotation(i).dot(a));
  return rotation;
}

RelativeMeasure seen_from_first(const Vector3d &a)
{
  RelativeMeasure displacement;
  displacement.a       = a;
  displacement.carrier = RelativeMeasure::Carrier::first;
  return displacement;
}

std::string axis_name(const Vector3d &a, int number)
{
  for (int d = 0; d < 3; ++d)
    if (std::abs(a[d] - 1.) < 1e-12)
      return std::string(1, "xyz"[d]);
  return std::to_string(number);
}

/// The equations of a joint, one after the other.
class Equations
{
public:
  explicit Equations(const Pair &pair) : pair_(pair) {}

  std::vector<IdealJoint::Equation> list;

  /// In the plane of a planar body only its directions count, as the plane itself does not move.
  std::vector<Vector3d> directions() const
  {
    if (const Body *body = pair_.planar())
    {
      std::vector<Vector3d> plane{vector(body->e_1), vector(body->e_2)};
      if (partner_leaves_plane(*body))
        plane.push_back(vector(body->axis));
      return plane;
    }
    return {Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()};
  }

  std::vector<Vector3d> axes_of_rotation() const
  {
    if (const Body *body = pair_.planar())
      return {vector(body->axis)};
    return {Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()};
  }

  /// A point, or a body of another plane, has to be held in this one too; a frame and what it carries does not, as the
  /// plane cannot yield.
  bool partner_leaves_plane(const Body &planar) const
  {
    const Body *partner = pair_.on_first == &planar ? pair_.on_second : pair_.on_first;
    return partner && (partner->kind == BodyKind::point ||
                       (partner->kind == BodyKind::planar &&
                        std::abs(vector(partner->axis).dot(vector(planar.axis))) < 1. - 1e-12));
  }

  void coincide()
  {
    int number = 0;
    for (const Vector3d &a : directions())
      along(a, RelativeMeasure::Carrier::space, "f" + axis_name(a, ++number), 0.);
  }

  void no_rotation()
  {
    for (const Body *body : {pair_.on_first, pair_.on_second})
      if (body && body->kind == BodyKind::point)
        return; // it has no rotation to compare with
    int number = 0;
    for (const Vector3d &a : axes_of_rotation())
    {
      IdealJoint::Equation equation;
      equation.name = pair_.planar() ? "torque" : "m" + axis_name(a, ++number);
      equation.unit = "N m";
      ratio(equation, a, 1.);
    }
  }

  /// a . (x_2 - x_1) stays as described, or is `value`; left out where neither body moves along a.
  void along(const Vector3d &a, RelativeMeasure::Carrier carrier, const std::string &name, std::optional<double> value)
  {
    IdealJoint::Equation equation;
    equation.name            = name;
    equation.measure.a       = a;
    equation.measure.carrier = carrier;
    double       gradient;
    const double s  = pair_.at_start(equation.measure, gradient);
    equation.offset = value ? *value : s;
    if (gradient > immobile)
      list.push_back(equation);
  }

  /// Rotation of body 2 about a = factor times that of body 1.
  void ratio(IdealJoint::Equation equation, const Vector3d &a, double factor)
  {
    equation.measure = rotation_about(pair_, a, factor);
    double largest   = 0.;
    for (const double c : equation.measure.ratios)
      largest = std::max(largest, std::abs(c));
    if (largest > immobile)
      list.push_back(equation);
  }

  void distance(const JointRequest &joint)
  {
    IdealJoint::Equation equation;
    equation.name         = "force";
    equation.measure.form = Form::distance;
    double       gradient;
    const double s  = pair_.at_start(equation.measure, gradient);
    equation.offset = joint.length ? *joint.length : s;
    equation.driven = joint.law != nullptr;
    if (!(equation.offset > 0.))
      throw std::invalid_argument("the two places lie together, so that a distance has no direction; use a revolute or "
                                  "spherical joint, or give 'at_from' and 'at_to'");
    list.push_back(equation);
  }

  /// The coordinate of body 2 is `factor` times that of body 1: angle of a rotor, displacement of a slider ...
  void gear(double factor)
  {
    IdealJoint::Equation equation;
    equation.name         = "torque";
    equation.unit         = pair_.on_second && pair_.on_second->kind == BodyKind::slider ? "N" : "N m";
    equation.measure.form = Form::ratio;
    const auto add        = [&](const Placement &placement, const Body *body, double c)
    {
      if (!body || body->kind == BodyKind::point)
        throw std::invalid_argument(
            "a gear couples rotors, sliders and planar bodies by their one angle or displacement");
      const Vector3d a = vector(body->axis);
      for (int i = 0; i < placement.n_measures(); ++i)
        equation.measure.ratios.push_back(
            c * (body->kind == BodyKind::slider ? placement.translation(i) : placement.rotation(i)).dot(a));
    };
    add(pair_.first, pair_.on_first, -factor);
    add(pair_.second, pair_.on_second, 1.);
    if (equation.unit == "N")
      equation.name = "force";
    list.push_back(equation);
  }

private:
  const Pair &pair_;
};

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
  const Vector3d axis = vector(joint.axis);
  if (joint.type == JointType::prismatic)
    attach_friction<1>(machine, pair, *joint.friction, equations, {seen_from_first(axis)});
  else if (joint.type == JointType::in_plane)
  {
    const auto [e_1, e_2] = coupling::plane_across(joint.axis);
    attach_friction<2>(machine, pair, *joint.friction, equations,
                       {seen_from_first(vector(e_1)), seen_from_first(vector(e_2))});
  }
  else
  {
    const Body *body = pair.planar();
    for (const Body *other : {pair.on_first, pair.on_second})
      if (!body && other && other->kind == BodyKind::rotor)
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
  if (joint.type == JointType::revolute)
    if (const Body *body = pair.planar())
      machine.draw_pin({placed(machine, joint.from), body->axis});
}

/// The level of a switch is told in the unit of its signal.
void check_level(const coupling::Machine &machine, const SwitchRequest &request)
{
  const coupling::Signal signal = machine.signal(request.request.name, request.request.signal);
  if (!request.level.checked || signal.unit.empty() || signal.unit == "1")
    return;
  const Quantity unit = parse_quantity("1 " + signal.unit, [](const std::string &) { return std::nullopt; });
  if (!equal(unit.dimension, request.level.dimension))
    throw std::invalid_argument("the signal \"" + request.request.signal + "\" is told in " + signal.unit +
                                ", but the level is " + describe(request.level.dimension));
}

} // namespace

void add_joint(coupling::Machine &machine, const JointRequest &joint)
{
  if (joint.type == JointType::measure)
  {
    add_measure_joint(machine, joint);
    return;
  }
  const Pair pair(machine, joint.from, joint.to);
  Equations  equations(pair);
  switch (joint.type)
  {
  case JointType::revolute:
  case JointType::spherical:
    equations.coincide();
    break;
  case JointType::rigid:
    equations.coincide();
    equations.no_rotation();
    break;
  case JointType::prismatic:
  case JointType::in_plane:
  {
    const Vector3d axis   = vector(joint.axis);
    int            number = 0;
    if (joint.type == JointType::in_plane)
      equations.along(axis, RelativeMeasure::Carrier::first, "force", std::nullopt);
    else
    {
      for (const Vector3d &a : equations.directions())
      {
        Vector3d across = a - a.dot(axis) * axis;
        if (across.norm() < 1e-9 || (equations.list.size() == 1 && !pair.planar() &&
                                     across.cross(equations.list[0].measure.a).norm() < 1e-9 * across.norm()))
          continue;
        across.normalize();
        if (!equations.list.empty() && std::abs(across.dot(equations.list[0].measure.a)) > 1e-9)
          across = axis.cross(equations.list[0].measure.a);
        if (equations.list.size() < (pair.planar() ? 1u : 2u))
          equations.along(across, RelativeMeasure::Carrier::first, "f" + axis_name(across, ++number), std::nullopt);
      }
      equations.no_rotation();
    }
    break;
  }
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
  machine.attach(joint.name, std::make_shared<IdealJoint>(pair.first, pair.second, equations.list, joint.law),
                 pair.measures);
  if (joint.friction)
    add_joint_friction(machine, joint, pair, equations.list);
  draw_joint(machine, joint, pair);
}

void attach_between(coupling::Machine &machine, const ElementRequest &element)
{
  const PairRequest           &request = *element.pair;
  const Pair                   pair(machine, request.from, request.to);
  std::vector<RelativeMeasure> measures;
  const Body                  *planar = pair.planar();
  if (request.about && planar && std::abs(vector(planar->axis).dot(vector(*request.about))) < 1. - 1e-9)
    throw std::invalid_argument("its axis must stand across the plane of \"" + planar->name +
                                "\", which turns about its normal only");
  for (const Vector3 &a : request.along)
    measures.push_back(seen_from_first(vector(a)));
  if (request.about)
    measures.push_back(rotation_about(pair, vector(*request.about), 1.));
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
  check_level(machine, request);
  machine.add_switch(request.request);
}

} // namespace gestell::apps
