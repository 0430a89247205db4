#include "apps/scene/joints/joint_equations.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

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

std::string axis_name(const Vector3d &a, int number)
{
  for (int d = 0; d < 3; ++d)
    if (std::abs(a[d] - 1.) < 1e-12)
      return std::string(1, "xyz"[d]);
  return std::to_string(number);
}

std::vector<Vector3d> global_axes()
{
  return {Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()};
}

bool are_parallel(const Vector3d &a, const Vector3d &b)
{
  // 1 - cosine: rounding of unit vectors, enlarged by bodies of some hundred metres
  constexpr double parallel = 1e-12;
  return std::abs(a.dot(b)) > 1. - parallel;
}

bool is_global(const Vector3d &axis)
{
  const std::vector<Vector3d> all = global_axes();
  return std::any_of(all.begin(), all.end(), [&](const Vector3d &a) { return are_parallel(a, axis); });
}

/// At most `at_most` unit vectors, orthogonal to the axis and to each other, as near to `directions` as possible.
std::vector<Vector3d> across(const Vector3d &axis, const std::vector<Vector3d> &directions, std::size_t at_most)
{
  std::vector<Vector3d> found;
  for (const Vector3d &a : directions)
  {
    Vector3d side = a - a.dot(axis) * axis;
    // Smallest sine of the angle between directions that define a normal; smaller angles would amplify rounding too
    // much.
    constexpr double apart = 1e-3;
    if (side.norm() < apart || found.size() == at_most ||
        (found.size() == 1 && side.cross(found[0]).norm() < apart * side.norm()))
      continue;
    side.normalize();
    if (!found.empty() && std::abs(side.dot(found[0])) > 1e-9)
      side = axis.cross(found[0]);
    found.push_back(side);
  }
  return found;
}

} // namespace

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

RelativeMeasure angle_about(const Vector3d &a)
{
  RelativeMeasure angle;
  angle.form = Form::angle;
  angle.a    = a.unitOrthogonal();
  angle.b    = a.cross(angle.a);
  return angle;
}

RelativeMeasure seen_from_first(const Vector3d &a)
{
  RelativeMeasure displacement;
  displacement.a       = a;
  displacement.carrier = RelativeMeasure::Carrier::first;
  return displacement;
}

/// Three directions, first those in the plane of a planar body; for rotors and sliders the axis is one of them, so that
/// in each direction they either move or do not.
std::vector<Vector3d> JointEquations::directions() const
{
  const Body *body = pair_.planar();
  if (body && !pair_.in_space())
    return {vector(body->e_1), vector(body->e_2), vector(body->axis)};
  const std::vector<Vector3d> axes = pair_.in_space() ? std::vector<Vector3d>{} : pair_.fixed_axes();
  if (on_global_axes_ || std::all_of(axes.begin(), axes.end(), is_global))
    return global_axes();
  const Vector3d        third = axes.front();
  std::vector<Vector3d> preferred(axes.begin() + 1, axes.end());
  for (const Vector3d &a : global_axes())
    preferred.push_back(a);
  std::vector<Vector3d> basis = across(third, preferred, 2);
  basis.push_back(third);
  return basis;
}

/// For a planar body: its axis and, if the other body rotates about a different axis, that axis (made orthogonal).
std::vector<Vector3d> JointEquations::axes_of_rotation() const
{
  if (!pair_.planar() || pair_.in_space())
    return directions();
  const std::vector<Vector3d> own = pair_.own_axes();
  std::vector<Vector3d>       axes{vector(pair_.planar()->axis)};
  for (const Vector3d &a : own)
    if (!are_parallel(a, axes[0]))
      axes.push_back((a - a.dot(axes[0]) * axes[0]).normalized());
  return axes;
}

/// Normal to its plane a planar body cannot be compliant: there it is constrained relative to bodies of the mechanism,
/// but not to a moving frame.
bool JointEquations::is_held(const RelativeMeasure &distance) const
{
  const Body *planar = pair_.planar();
  const bool  across = planar && !pair_.in_space() && are_parallel(distance.a, vector(planar->axis));
  return pair_.moves(distance, across ? pair_.n_frame : 0);
}

void JointEquations::coincide()
{
  holds_point = true;
  int number  = 0;
  for (const Vector3d &a : directions())
    along(a, held_by_, "f" + axis_name(a, ++number), 0.);
}

void JointEquations::on_line(const Vector3d &axis, std::optional<double> distance)
{
  int number = 0;
  for (const Vector3d &a : across(axis, directions(), 2))
    along(a, Carrier::first, "f" + axis_name(a, ++number), distance);
}

void JointEquations::in_plane(const Vector3d &axis)
{
  add(distance_along(axis, Carrier::first, "force"), std::nullopt);
}

void JointEquations::no_rotation()
{
  if (pair_.has_point())
    return;
  int number = 0;
  for (const Vector3d &a : axes_of_rotation())
  {
    const std::string name = "m" + axis_name(a, ++number);
    if (pair_.in_space())
    {
      hold_about(a, a.unitOrthogonal(), name);
      continue;
    }
    IdealJoint::Equation equation;
    equation.name = pair_.planar() ? "torque" : name;
    equation.unit = "N m";
    ratio(equation, a, 1.);
  }
}

void JointEquations::one_axis(const Vector3d &axis)
{
  if (pair_.has_point())
    return;
  int                   number    = 0;
  std::vector<Vector3d> preferred = pair_.in_space() ? std::vector<Vector3d>{} : pair_.own_axes();
  for (const Vector3d &a : global_axes())
    preferred.push_back(a);
  for (const Vector3d &a : across(axis, preferred, 2))
    hold_about(a, axis, "m" + axis_name(a, ++number));
}

/// a . b_2 = 0 with b x a = axis: its multiplier is the torque on body 2 about the axis.
void JointEquations::hold_about(const Vector3d &axis, const Vector3d &across, const std::string &name)
{
  at_right_angles(across, across.cross(axis).normalized(), name);
}

void JointEquations::at_right_angles(const Vector3d &a, const Vector3d &b, const std::string &name)
{
  IdealJoint::Equation equation;
  equation.name         = name;
  equation.unit         = "N m";
  equation.measure.form = Form::square;
  equation.measure.a    = a;
  equation.measure.b    = b;
  add(equation, 0.);
}

IdealJoint::Equation JointEquations::distance_along(const Vector3d &a, Carrier carrier, const std::string &name)
{
  IdealJoint::Equation equation;
  equation.name            = name;
  equation.measure.a       = a;
  equation.measure.carrier = carrier;
  return equation;
}

/// Keeps the distance of the points along a constant: at its value in the reference configuration, or at `value`.
void JointEquations::along(const Vector3d &a, Carrier carrier, const std::string &name, std::optional<double> value)
{
  const IdealJoint::Equation equation = distance_along(a, carrier, name);
  const bool                 held     = is_held(equation.measure);
  if (value && !held)
    require_closed(a, pair_.at_start(equation.measure) - *value);
  if (held)
    add(equation, value);
}

/// A gap that no motion can close must be zero in the reference configuration.
void JointEquations::require_closed(const Vector3d &a, double gap) const
{
  constexpr double closed = 1e-10; // share of the numbers of its places by which the assembly leaves a joint open
  if (std::abs(gap) <= closed * pair_.size())
    return;
  std::ostringstream message;
  message << "has a gap of " << std::abs(gap) << " m along [" << a[0] << ", " << a[1] << ", " << a[2]
          << "], where neither body can move; make 'at_from' and 'at_to' coincide in this direction, or give only 'at'";
  throw std::invalid_argument(message.str());
}

/// s keeps its reference value, or has `value`; omitted if neither body changes it.
void JointEquations::add(IdealJoint::Equation equation, std::optional<double> value)
{
  equation.offset = value ? *value : pair_.at_start(equation.measure);
  if (pair_.moves(equation.measure))
    list.push_back(std::move(equation));
}

/// The rotation of body 2 about a equals factor times the rotation of body 1.
void JointEquations::ratio(IdealJoint::Equation equation, const Vector3d &a, double factor)
{
  equation.measure = rotation_about(pair_, a, factor);
  if (pair_.moves(equation.measure))
    list.push_back(equation);
}

void JointEquations::distance(const JointRequest &joint)
{
  IdealJoint::Equation equation;
  equation.name         = "force";
  equation.measure.form = Form::distance;
  equation.offset       = joint.length ? *joint.length : pair_.at_start(equation.measure);
  equation.driven       = joint.law != nullptr;
  if (!(equation.offset > 0.))
    throw std::invalid_argument("the two points coincide, so the distance has no direction; use a revolute or "
                                "spherical joint, or give 'at_from' and 'at_to'");
  list.push_back(equation);
}

void JointEquations::gear(double factor)
{
  IdealJoint::Equation equation;
  equation.name         = "torque";
  equation.unit         = pair_.on_second && pair_.on_second->kind == BodyKind::slider ? "N" : "N m";
  equation.measure.form = Form::ratio;
  const auto add_body   = [&](const Placement &placement, const Body *body, double c)
  {
    if (!body || body->kind == BodyKind::point || body->kind == BodyKind::rigid)
      throw std::invalid_argument("a gear couples angles of rotors and planar bodies, or displacements of sliders");
    const Vector3d a = vector(body->axis);
    for (int i = 0; i < placement.n_measures(); ++i)
      equation.measure.ratios.push_back(
          c * (body->kind == BodyKind::slider ? placement.translation(i) : placement.rotation(i)).dot(a));
  };
  add_body(pair_.first, pair_.on_first, -factor);
  add_body(pair_.second, pair_.on_second, 1.);
  if (equation.unit == "N")
    equation.name = "force";
  list.push_back(equation);
}

void JointEquations::leave_out_idle(Pair &pair)
{
  const int         n_1 = pair.first.n_measures(), n = int(pair.measures.size());
  std::vector<char> felt(n, 0);
  double            u[PlacedMeasure::max_measures], G[PlacedMeasure::max_measures];
  const double      at_rest[PlacedMeasure::max_measures] = {};
  for (int sample = 0; sample < 3; ++sample)
  {
    sample_motion(sample, pair, u);
    for (const IdealJoint::Equation &equation : list)
    {
      PlacedMeasure{pair.first, pair.second, equation.measure}.evaluate(u, at_rest, G);
      for (int i = 0; i < n; ++i)
        felt[i] = felt[i] || std::abs(G[i]) > immobile * largest_gradient(pair, equation.measure, i);
    }
  }
  for (int i = n - 1; i >= 0; --i)
  {
    Placement &placement = i < n_1 ? pair.first : pair.second;
    const int  own       = i < n_1 ? i : i - n_1;
    if (felt[i] || !placement.is_linear(own))
      continue;
    placement = placement.without(own);
    pair.measures.erase(pair.measures.begin() + i);
    for (IdealJoint::Equation &equation : list)
      if (!equation.measure.ratios.empty())
        equation.measure.ratios.erase(equation.measure.ratios.begin() + i);
  }
}

void JointEquations::join_translations(Pair &pair)
{
  using coupling::operator-;
  const auto      moves_along = [](const Placement &placement, int i, const Vector3d &t)
  { return placement.is_linear(i) && placement.rotation(i).isZero(0.) && placement.translation(i) == t; };
  for (int i = pair.first.n_measures() - 1; i >= 0; --i)
  {
    const Vector3d t = pair.first.translation(i);
    if (!moves_along(pair.first, i, t))
      continue;
    const int n_1 = pair.first.n_measures();
    for (int j = 0; j < pair.second.n_measures(); ++j)
    {
      if (!moves_along(pair.second, j, t))
        continue;
      pair.measures[n_1 + j] = pair.measures[n_1 + j] - pair.measures[i];
      pair.measures.erase(pair.measures.begin() + i);
      pair.first = pair.first.without(i);
      for (IdealJoint::Equation &equation : list) // of rotations, to which a translation adds nothing
        if (!equation.measure.ratios.empty())
          equation.measure.ratios.erase(equation.measure.ratios.begin() + i);
      break;
    }
  }
}

} // namespace gestell::apps
