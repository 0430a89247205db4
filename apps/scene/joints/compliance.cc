#include "apps/scene/joints/compliance.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{
namespace
{

using mechanism::CompliantJoint;
using mechanism::IdealJoint;
using mechanism::RelativeMeasure;
using Carrier = RelativeMeasure::Carrier;

/// One number for all directions, or three along the global axes.
Vector3 read_directed(const SceneTable &table, const std::string &key, const Kind &kind, ComplianceRequest &compliance)
{
  if (!table.is_array(key))
  {
    const double all = table.value(key);
    return {all, all, all};
  }
  compliance.directed   = true;
  const Vector3 numbers = table.vector(key, kind);
  for (const double number : numbers)
    if (number < 0.)
      throw table.error(key, "needs three values of zero or more");
  return numbers;
}

} // namespace

const std::vector<Key> &compliance_keys()
{
  static const std::vector<Key> keys = {
      key::number("stiffness", kind::stiffness,
                  "stiffness in every direction that the joint constrains, or `[x, y, z]` along the global axes in the "
                  "reference configuration, which then rotate with `from`; 0 leaves a direction free")
          .from_zero()
          .also({Key::Form::vector})
          .by_default("ideal"),
      key::number("damping", kind::damping, "damping in the same directions")
          .from_zero()
          .also({Key::Form::vector})
          .by_default(0.),
      key::number("rotational_stiffness", kind::torsional_stiffness,
                  "rotational stiffness about every constrained axis. Required with `stiffness` if the joint "
                  "constrains rotations: a pin of planar bodies constrains none, that of a rigid body two")
          .above_zero()
          .by_default("ideal")
          .into(&ComplianceRequest::rotational_stiffness),
      key::number("rotational_damping", kind::torsional_damping, "damping about the same axes")
          .from_zero()
          .by_default("0")
          .into(&ComplianceRequest::rotational_damping)};
  return keys;
}

std::optional<ComplianceRequest> read_compliance(const SceneTable &any, const JointType &type)
{
  const SceneTable table = any.declared(compliance_keys());
  const char      *given = nullptr;
  for (const char *key : {"rotational_damping", "rotational_stiffness", "damping", "stiffness"})
    if (table.has(key))
      given = key;
  if (!given)
    return std::nullopt;
  if (!any.declared(type.keys).declares("stiffness"))
    throw any.error(given,
                    "applies to a joint of two points, not to a \"" + type.name +
                        "\"; use a spring-damper `on` a [measure] of type " +
                        (type.drawn == JointType::Drawn::bar ? "\"distance\"" : "\"sum\" or \"position function\""));
  if (!table.has("stiffness"))
    throw any.error("needs 'stiffness' in addition to '" + std::string(given) +
                    "'; a joint without stiffness is ideal");
  if (any.has("friction"))
    throw any.error("friction", "is for ideal joints only; for a compliant joint add an element of type \"friction\", "
                                "or use a \"journal bearing\"");
  auto compliance      = table.filled<ComplianceRequest>();
  compliance.stiffness = read_directed(table, "stiffness", kind::stiffness, compliance);
  compliance.damping   = read_directed(table, "damping", kind::damping, compliance);
  if (compliance.stiffness == Vector3{})
    throw any.error("stiffness", "is zero in every direction, so the joint would constrain nothing; remove it");
  return compliance;
}

/// A single stiffness is the same along any axes; a damper must not brake a rotation together with its body.
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

namespace
{

/// The equations of a joint, each with what keeps it closed.
std::vector<CompliantJoint::Equation> yielding(const JointRequest &joint, const JointEquations &equations)
{
  const ComplianceRequest              &compliance = *joint.compliance;
  std::vector<CompliantJoint::Equation> all;
  bool                                  turns = false;
  for (const IdealJoint::Equation &demand : equations.list)
  {
    CompliantJoint::Equation equation{demand, 0., 0.};
    equation.told_as_described =
        demand.unit == "N" && demand.measure.carrier == Carrier::first && equations.holds_point;
    if (demand.unit == "N")
      for (int d = 0; d < 3; ++d)
      {
        const double share = demand.measure.a[d] * demand.measure.a[d];
        if (compliance.directed && share > 1e-12 && share < 1. - 1e-12)
          throw std::invalid_argument("three values of 'stiffness' or 'damping' refer to global axes, but the joint "
                                      "has other directions; give one value for all directions");
        equation.stiffness += share * compliance.stiffness[d];
        equation.damping += share * compliance.damping[d];
      }
    else
    {
      turns = true;
      if (!compliance.rotational_stiffness)
        throw std::invalid_argument("constrains a rotation (" + demand.name +
                                    "), so it needs 'rotational_stiffness' in addition to 'stiffness'");
      equation.stiffness = *compliance.rotational_stiffness;
      equation.damping   = compliance.rotational_damping.value_or(0.);
    }
    all.push_back(equation);
  }
  if (!turns && (compliance.rotational_stiffness || compliance.rotational_damping))
    throw std::invalid_argument(
        "constrains no rotation of these bodies; remove 'rotational_stiffness' and 'rotational_damping'");
  return all;
}

/// Whether s is linear in the motion of the two bodies: s'' = 0 in three positions of no order.
bool is_linear(const Pair &pair, const RelativeMeasure &s)
{
  using mechanism::PlacedMeasure;
  constexpr double straight = 1e-12; // of a second derivative by the values: rounding of products of unit vectors
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

/// If all s are linear, as for a free spatial body fixed to the ground, each becomes one measure.
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
        mechanism::PlacedMeasure{pair.first, pair.second, demand.measure}.evaluate(zero, zero, G).s; // initially
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

} // namespace

std::shared_ptr<CompliantJoint> compliant_joint(const JointRequest &joint, const JointEquations &equations, Pair &pair)
{
  auto held = yielding(joint, equations);
  take_as_measures(pair, held);
  return std::make_shared<CompliantJoint>(pair.first, pair.second, std::move(held));
}

} // namespace gestell::apps
