#include "apps/scene/build/build_joints.h"

#include "apps/scene/build/build_joint_friction.h"
#include "apps/scene/build/build_measures.h"
#include "apps/scene/build/joint_equations.h"
#include "apps/scene/language/parse_quantity.h"
#include "apps/scene/language/quantity.h"
#include "mechanism/joints/compliant_joint.h"
#include "mechanism/transmitted_element.h"

#include <cmath>

namespace gestell::apps
{
namespace
{

using mechanism::CompliantJoint;
using mechanism::IdealJoint;
using mechanism::RelativeMeasure;
using Carrier = RelativeMeasure::Carrier;

/// What carries the directions of a point that yields.  One stiffness is the same along any axes; a damper must not
/// brake what turns with the body it is on.
Carrier carrier_of(const JointRequest &joint, const Pair &pair)
{
  using coupling::BodyKind;
  if (!joint.compliance || joint.compliance->directed)
    return joint.compliance ? Carrier::first : Carrier::space;
  const coupling::Body *first = pair.on_first;
  const bool            turns =
      first && (first->kind == BodyKind::rotor || first->kind == BodyKind::planar || first->kind == BodyKind::rigid);
  const bool damped = joint.compliance->damping != Vector3{};
  return turns && damped ? Carrier::first : Carrier::space;
}

/// Whether it holds two places together: its forces are told along axes fixed in space.
bool holds_point(JointType type)
{
  return type == JointType::revolute || type == JointType::spherical || type == JointType::universal ||
         type == JointType::rigid;
}

/// The equations of a joint, each with what keeps it closed.
std::vector<CompliantJoint::Equation> yielding(const JointRequest                      &joint,
                                               const std::vector<IdealJoint::Equation> &equations)
{
  const ComplianceRequest              &compliance = *joint.compliance;
  std::vector<CompliantJoint::Equation> all;
  bool                                  turns = false;
  for (const IdealJoint::Equation &demand : equations)
  {
    CompliantJoint::Equation equation{demand, 0., 0.};
    equation.told_as_described =
        demand.unit == "N" && demand.measure.carrier == Carrier::first && holds_point(joint.type);
    if (demand.unit == "N")
      for (int d = 0; d < 3; ++d)
      {
        const double share = demand.measure.a[d] * demand.measure.a[d];
        if (compliance.directed && share > 1e-12 && share < 1. - 1e-12)
          throw std::invalid_argument("three values of 'stiffness' or 'damping' are those along global axes, but the "
                                      "joint's own directions lie between them; give one value for all directions");
        equation.stiffness += share * compliance.stiffness[d];
        equation.damping += share * compliance.damping[d];
      }
    else
    {
      turns = true;
      if (!compliance.rotational_stiffness)
        throw std::invalid_argument("holds a rotation (" + demand.name +
                                    ") too: it needs 'rotational_stiffness' beside 'stiffness'");
      equation.stiffness = *compliance.rotational_stiffness;
      equation.damping   = compliance.rotational_damping.value_or(0.);
    }
    all.push_back(equation);
  }
  if (!turns && (compliance.rotational_stiffness || compliance.rotational_damping))
    throw std::invalid_argument("holds no rotation of these bodies; leave out 'rotational_stiffness' and "
                                "'rotational_damping'");
  return all;
}

/// Whether s is linear in the motion of the two bodies: s'' = 0 in three positions of no order.
bool is_linear(const Pair &pair, const RelativeMeasure &s)
{
  using mechanism::PlacedMeasure;
  constexpr double straight = 1e-12;
  const int        k        = int(pair.measures.size());
  Eigen::VectorXd  u(k);
  Eigen::MatrixXd  curvature(k, k);
  for (int sample = 0; sample < 3; ++sample)
  {
    for (int i = 0; i < k; ++i)
      u[i] = 0.5 * std::sin(1. + 7.3 * i + 2.1 * sample);
    curvature.setZero();
    PlacedMeasure{pair.first, pair.second, s}.add_curvature(u.data(), 1., curvature.data());
    if (!curvature.isZero(straight))
      return false;
  }
  return true;
}

/// Where all s are linear, as of a body in space that is held on the ground, each is one measure, whatever it is made
/// of.
void take_as_measures(Pair &pair, std::vector<CompliantJoint::Equation> &equations)
{
  using coupling::operator+, coupling::operator*;
  for (const auto &equation : equations)
    if (!is_linear(pair, equation.demand.measure))
      return;
  const double                   zero[mechanism::PlacedMeasure::max_measures] = {};
  double                         G[mechanism::PlacedMeasure::max_measures];
  std::vector<coupling::Measure> measures;
  for (std::size_t i = 0; i < equations.size(); ++i)
  {
    IdealJoint::Equation &demand = equations[i].demand;
    demand.offset -=
        mechanism::PlacedMeasure{pair.first, pair.second, demand.measure}.evaluate(zero, zero, G).s; // as described
    measures.emplace_back();
    for (std::size_t k = 0; k < pair.measures.size(); ++k)
      measures.back() = measures.back() + G[k] * pair.measures[k];
    demand.measure.form = RelativeMeasure::Form::ratio;
    demand.measure.ratios.assign(equations.size(), 0.);
    demand.measure.ratios[i] = 1.;
  }
  using mechanism::Placement, mechanism::Vector3d;
  const Placement::LinearMeasure own{Vector3d::Zero(), Vector3d::Zero()};
  pair.first    = Placement(Vector3d::Zero(), Vector3d::Zero(), std::vector(equations.size(), own));
  pair.second   = Placement();
  pair.measures = measures;
}

/// What a joint looks like: a bar, a pin; of others only the points where they hold.
void draw_joint(coupling::MachineModel &machine, const JointRequest &joint, const Pair &pair)
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
void check_level(const coupling::MachineModel &machine, const SwitchRequest &request, const Quantity &level,
                 const std::string &what)
{
  const coupling::Signal signal = machine.signal(request.request.name, request.request.signal);
  if (!level.checked || signal.unit.empty() || signal.unit == "1")
    return;
  const Quantity unit = parse_quantity("1 " + signal.unit, [](const std::string &) { return std::nullopt; });
  if (!equal(unit.dimension, level.dimension))
    throw std::invalid_argument("the signal \"" + request.request.signal + "\" is in " + signal.unit + ", but the " +
                                what + " is " + describe(level.dimension));
  const Kind kind{what + " of a signal in " + signal.unit, "20 1/min", unit.dimension,
                  unit.counts == Counts::radians ? Counts::turns : Counts::nothing};
  value_as(level, kind, describe(level.dimension));
}

/// The equations that its type demands.
void demand(const JointRequest &joint, const Pair &pair, JointEquations &equations)
{
  const auto axis = vector(joint.axis);
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
}

} // namespace

void add_joint(coupling::MachineModel &machine, const JointRequest &joint)
{
  if (joint.type == JointType::measure)
  {
    add_measure_joint(machine, joint);
    return;
  }
  const Pair     pair(machine, joint.from, joint.to);
  const bool     directed = joint.compliance && joint.compliance->directed;
  JointEquations equations(pair, directed, carrier_of(joint, pair));
  demand(joint, pair, equations);
  if (equations.list.empty())
    throw std::invalid_argument("holds nothing: neither body can move in the way the joint forbids");
  Pair felt = pair;
  equations.leave_out_idle(felt);
  if (joint.compliance)
  {
    equations.join_translations(felt);
    auto held = yielding(joint, equations.list);
    take_as_measures(felt, held);
    machine.attach(joint.name, std::make_shared<CompliantJoint>(felt.first, felt.second, std::move(held)),
                   felt.measures);
  }
  else
    machine.attach(joint.name, std::make_shared<IdealJoint>(felt.first, felt.second, equations.list, joint.law),
                   felt.measures);
  if (joint.friction)
    add_joint_friction(machine, joint, pair, equations.list);
  draw_joint(machine, joint, pair);
}

void attach_between(coupling::MachineModel &machine, const ElementRequest &element)
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

void add_switch(coupling::MachineModel &machine, const SwitchRequest &request)
{
  machine.add_switch(request.request); // refuses a signal that there is not, in words of its own
  check_level(machine, request, request.level, "level");
  if (request.hysteresis)
    check_level(machine, request, *request.hysteresis, "hysteresis");
}

} // namespace gestell::apps
