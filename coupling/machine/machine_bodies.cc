#include "coupling/machine/machine.h"
#include "coupling/machine/machine_parts.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gestell::coupling
{

namespace
{
Vector3 unit(const Vector3 &a, const std::string &place)
{
  const double length = std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
  if (!(length > 0.))
    throw std::invalid_argument(place + ": the axis has length zero; give a direction such as [0, 0, -1]");
  return {a[0] / length, a[1] / length, a[2] / length};
}

/// The part of a motion across the axis a.
std::array<Measure, 3> across(const std::array<Measure, 3> &motion, const Vector3 &a)
{
  Measure along;
  for (int d = 0; d < 3; ++d)
    along = along + a[d] * motion[d];
  return {motion[0] - a[0] * along, motion[1] - a[1] * along, motion[2] - a[2] * along};
}

void check_mass(double mass, const std::string &what)
{
  if (!(mass >= 0.) || !std::isfinite(mass))
    throw std::invalid_argument(what + " is " + std::to_string(mass) + "; it must be zero or positive");
}

void require_mass(double mass, const std::string &what)
{
  if (!(mass > 0.) || !std::isfinite(mass))
    throw std::invalid_argument(what + " is " + std::to_string(mass) + "; it must be positive");
}
} // namespace

int MachineModel::add_rotor(const std::string &name, const Vector3 &axis, double inertia, double mass,
                            const std::string &carrier)
{
  if (!(inertia > 0.))
    throw std::invalid_argument("rotor \"" + name + "\": inertia " + std::to_string(inertia) +
                                " kg m^2 must be positive");
  check_mass(mass, "rotor \"" + name + "\": mass [kg]");
  const Vector3 a    = unit(axis, "rotor \"" + name + "\"");
  const Marker &base = marker(carrier);
  parts_->refuse_free_carrier(base, "rotor \"" + name + "\"");
  Marker own    = base;
  own.name      = name;
  const int phi = parts_->add_coordinates(name, {name});
  own.rotation  = across(base.rotation, a);
  for (int d = 0; d < 3; ++d)
    own.rotation[d] = own.rotation[d] + a[d] * Measure{{phi, 1.}};
  parts_->add_dyad(parts_->M, inertia, {{phi, 1.}});
  parts_->add_mass(mass, base.translation);
  parts_->add_body(
      {name, BodyKind::rotor, phi, a, parts_->position_of(carrier), 0., {}, own, parts_->position_of(carrier)});
  return phi;
}

int MachineModel::add_slider(const std::string &name, const Vector3 &axis, double mass, const std::string &guide)
{
  check_mass(mass, "slider \"" + name + "\": mass [kg]");
  if (mass == 0.)
    throw std::invalid_argument("slider \"" + name + "\": mass 0 kg; a slider needs a positive mass");
  const Vector3 a    = unit(axis, "slider \"" + name + "\"");
  const Marker &base = marker(guide);
  parts_->refuse_free_carrier(base, "slider \"" + name + "\"");
  Marker own;
  own.name            = name;
  own.rotation        = base.rotation;
  const int  x        = parts_->add_coordinates(name, {name});
  const auto sideways = across(base.translation, a);
  for (int d = 0; d < 3; ++d)
    own.translation[d] = sideways[d] + a[d] * Measure{{x, 1.}};
  // Directions along a and across it are uncoupled; adding them separately keeps rounding from coupling them.
  parts_->add_dyad(parts_->M, mass, {{x, 1.}});
  for (int d = 0; d < 3; ++d)
    parts_->add_dyad(parts_->M, mass, sideways[d]);
  parts_->add_loads(mass, own.translation);
  parts_->add_body({name, BodyKind::slider, x, a, parts_->position_of(guide), 0., {}, own, parts_->position_of(guide)});
  return x;
}

int MachineModel::add_point(const std::string &name, double mass, const Vector3 &position)
{
  require_mass(mass, "point \"" + name + "\": mass [kg]");
  const int first = parts_->add_coordinates(name, {name + ".ux", name + ".uy", name + ".uz"});
  Marker    own;
  own.name = name;
  for (int d = 0; d < 3; ++d)
    own.translation[d] = {{first + d, 1.}};
  parts_->add_mass(mass, own.translation);
  parts_->add_body({name, BodyKind::point, first, {}, position, 0., {}, own, position});
  return first;
}

namespace
{
/// The global axis parallel to the unit vector n; -1: none.
int global_axis(const Vector3 &n)
{
  for (int d = 0; d < 3; ++d)
    if (std::abs(std::abs(n[d]) - 1.) < 1e-12)
      return d;
  return -1;
}

} // namespace

std::pair<Vector3, Vector3> plane_across(const Vector3 &n)
{
  Vector3 e_1{}, e_2{};
  if (const int axis = global_axis(n); axis >= 0)
  {
    e_1[axis == 0 ? 1 : 0] = e_2[axis == 2 ? 1 : 2] = 1.;
    return {e_1, e_2};
  }
  int least = 0;
  for (int d = 1; d < 3; ++d)
    if (std::abs(n[d]) < std::abs(n[least]))
      least = d;
  Vector3 e{};
  e[least] = 1.;
  for (int d = 0; d < 3; ++d)
    e_1[d] = e[d] - n[least] * n[d];
  e_1 = unit(e_1, "plane");
  for (int d = 0; d < 3; ++d)
    e_2[d] = n[(d + 1) % 3] * e_1[(d + 2) % 3] - n[(d + 2) % 3] * e_1[(d + 1) % 3];
  return {e_1, e_2};
}

std::array<std::string, 3> planar_coordinates(const std::string &name, const Vector3 &normal)
{
  const int axis = global_axis(normal);
  if (axis < 0)
    return {name + ".s1", name + ".s2", name + ".angle"};
  return {name + (axis == 0 ? ".uy" : ".ux"), name + (axis == 2 ? ".uy" : ".uz"), name + ".angle"};
}

int MachineModel::add_planar(const std::string &name, const Vector3 &normal, double mass, double inertia,
                             const Vector3 &position)
{
  require_mass(mass, "planar body \"" + name + "\": mass [kg]");
  require_mass(inertia, "planar body \"" + name + "\": inertia [kg m^2]");
  const Vector3 n       = unit(normal, "planar body \"" + name + "\"");
  const auto [e_1, e_2] = plane_across(n);
  const auto names      = planar_coordinates(name, n);
  const int  first      = parts_->add_coordinates(name, {names.begin(), names.end()});
  Marker     own;
  own.name = name;
  for (int d = 0; d < 3; ++d)
  {
    own.translation[d] = e_1[d] * Measure{{first, 1.}} + e_2[d] * Measure{{first + 1, 1.}};
    own.rotation[d]    = n[d] * Measure{{first + 2, 1.}};
  }
  parts_->add_mass(mass, own.translation);
  parts_->add_dyad(parts_->M, inertia, {{first + 2, 1.}});
  parts_->add_body({name, BodyKind::planar, first, n, position, 0., {}, own, position, e_1, e_2});
  return first;
}

namespace
{

using mechanism::Placement, mechanism::Vector3d;

Vector3d vector(const Vector3 &a)
{
  return {a[0], a[1], a[2]};
}

/// A point whose motion follows from translations and small rotations.
struct LinearPlace
{
  std::vector<Measure>                  measures;
  std::vector<Placement::LinearMeasure> motions;

  void add(const Measure &u, const Vector3d &translation, const Vector3d &rotation)
  {
    if (u.empty())
      return;
    measures.push_back(u);
    motions.push_back({translation, rotation});
  }
};

/// A rotation without that of one coordinate: for a rotor the part in which its carrier tilts its axis.
std::array<Measure, 3> without(std::array<Measure, 3> rotation, int coordinate)
{
  for (Measure &u : rotation)
    u.erase(std::remove_if(u.begin(), u.end(), [&](const auto &term) { return term.first == coordinate; }), u.end());
  return rotation;
}

/// For a body whose position depends only on its own coordinates.
PlacedPoint place_on(const Body &body, const Vector3 &at)
{
  const Vector3d centre = vector(body.centre), zero = Vector3d::Zero();
  PlacedPoint    placed;
  if (body.kind == BodyKind::rigid)
  {
    placed.placement = Placement::free(vector(at), centre);
    for (int i = 0; i < Placement::max_measures; ++i)
      placed.measures.push_back({{body.coordinate + i, 1.}});
    return placed;
  }
  LinearPlace linear;
  const int   n = body.kind == BodyKind::planar ? 2 : 3;
  for (int i = 0; i < n; ++i)
    linear.add({{body.coordinate + i, 1.}}, n == 3 ? Vector3d(Vector3d::Unit(i)) : vector(i == 0 ? body.e_1 : body.e_2),
               zero);
  placed.measures = linear.measures;
  if (n == 3)
    placed.placement = Placement(vector(at), centre, linear.motions);
  else
  {
    placed.placement = Placement(vector(at), centre, linear.motions, vector(body.axis));
    placed.measures.push_back({{body.coordinate + 2, 1.}});
  }
  return placed;
}

} // namespace

PlacedPoint MachineModel::place(const std::string &name, const Vector3 &at) const
{
  const Marker &own = marker(name);
  const Body   *on  = nullptr;
  for (const Body &body : parts_->bodies)
    if (body.name == name)
      on = &body;
  if (on && on->kind != BodyKind::rotor && on->kind != BodyKind::slider)
    return place_on(*on, at);
  const Vector3d centre = vector(on ? on->centre : parts_->position_of(name)), zero = Vector3d::Zero();
  LinearPlace    linear;
  const bool     turns            = on && on->kind == BodyKind::rotor;
  const bool     slides           = on && on->kind == BodyKind::slider;
  const auto     own_motion_alone = [&](const Measure &u)
  { return std::all_of(u.begin(), u.end(), [&](const auto &term) { return term.first == on->coordinate; }); };
  const auto rotation = turns ? without(own.rotation, on->coordinate) : own.rotation;
  refuse_far_turning(name, rotation);
  if (slides && std::all_of(own.translation.begin(), own.translation.end(), own_motion_alone))
    linear.add({{on->coordinate, 1.}}, vector(on->axis), zero); // guided by the ground
  else
    for (int d = 0; d < 3; ++d)
      linear.add(own.translation[d], Vector3d::Unit(d), zero);
  for (int d = 0; d < 3; ++d)
    linear.add(rotation[d], zero, Vector3d::Unit(d));
  PlacedPoint placed;
  placed.measures = linear.measures;
  if (turns)
  {
    placed.placement = Placement(vector(at), centre, linear.motions, vector(on->axis));
    placed.measures.push_back({{on->coordinate, 1.}});
  }
  else
    placed.placement = Placement(vector(at), centre, linear.motions);
  return placed;
}

/// A carrier's rotation is assumed small: with large rotations its loads would be stretched.
void MachineModel::refuse_far_turning(const std::string &name, const std::array<Measure, 3> &rotation) const
{
  for (const Body &body : parts_->bodies)
  {
    const int angle = body.kind == BodyKind::rotor    ? body.coordinate
                      : body.kind == BodyKind::planar ? body.coordinate + 2
                                                      : -1;
    for (const Measure &u : rotation)
      for (const auto &[coordinate, weight] : u)
        if (coordinate == angle && body.name != name)
          throw std::invalid_argument("\"" + name + "\" is carried by \"" + body.name +
                                      "\", which rotates through large angles that joints and measures cannot follow; "
                                      "use a planar body with a joint instead");
  }
}

Vector3 MachineModel::position(const std::string &name) const
{
  marker(name); // throws with the nearest name
  for (const Body &body : parts_->bodies)
    if (body.name == name)
      return body.centre;
  return parts_->position_of(name);
}

void MachineModel::add_measure(NamedMeasure measure)
{
  parts_->measures.push_back(std::move(measure));
}

void MachineModel::add_place(const std::string &name, const PlacedPoint &place)
{
  const auto &start = place.placement.point();
  parts_->places.push_back({name, int(parts_->measures.size()), {start[0], start[1], start[2]}});
  for (int d = 0; d < 3; ++d)
  {
    mechanism::PlacedMeasure along{mechanism::Placement(), place.placement, {}};
    along.measure.a = mechanism::Vector3d::Unit(d);
    add_measure({name + "." + "xyz"[d], "m", along, place.measures});
  }
}

double NamedMeasure::acceleration(const Eigen::VectorXd &q, const Eigen::VectorXd &v, const Eigen::VectorXd &a) const
{
  constexpr int most    = mechanism::CombinedMeasure::max_measures;
  double        u[most] = {}, rate[most] = {}, gradient[most];
  for (std::size_t i = 0; i < measures.size(); ++i)
    for (const auto &[coordinate, weight] : measures[i])
    {
      u[i] += weight * q[coordinate];
      rate[i] += weight * v[coordinate];
    }
  double value = measure.evaluate(u, rate, gradient).bias;
  for (std::size_t i = 0; i < measures.size(); ++i)
    for (const auto &[coordinate, weight] : measures[i])
      value += gradient[i] * weight * a[coordinate];
  return value;
}

mechanism::RelativeMeasure::Value NamedMeasure::evaluate(const Eigen::VectorXd &q, const Eigen::VectorXd &v,
                                                         Eigen::VectorXd *on_q) const
{
  double u[mechanism::CombinedMeasure::max_measures] = {}, rate[mechanism::CombinedMeasure::max_measures] = {};
  double gradient[mechanism::CombinedMeasure::max_measures];
  for (std::size_t i = 0; i < measures.size(); ++i)
    for (const auto &[coordinate, weight] : measures[i])
    {
      u[i] += weight * q[coordinate];
      rate[i] += weight * v[coordinate];
    }
  const auto value = measure.evaluate(u, rate, gradient);
  if (on_q)
  {
    on_q->setZero(q.size());
    for (std::size_t i = 0; i < measures.size(); ++i)
      for (const auto &[coordinate, weight] : measures[i])
        (*on_q)[coordinate] += weight * gradient[i];
  }
  return value;
}

void MachineModel::add_point_mass(const std::string &name, const std::string &marker_name, double mass,
                                  const Vector3 &inertia, const Vector3 &offset)
{
  check_mass(mass, "point mass \"" + name + "\": mass [kg]");
  const Marker &at = marker(marker_name);
  for (const Body &body : parts_->bodies)
    if (body.name == marker_name && body.kind == BodyKind::planar && offset != Vector3{})
      throw std::invalid_argument("point mass \"" + name + "\": an offset on \"" + marker_name +
                                  "\" would rotate with it, which needs a variable mass matrix; add mass and inertia "
                                  "to the body itself, or declare a separate body with a rigid joint");
  parts_->add_mass(mass, parts_->moved_point(at, offset));
  for (int d = 0; d < 3; ++d)
    check_mass(inertia[d], "point mass \"" + name + "\": inertia [kg m^2]");
  if (at.turns_freely)
    parts_->add_inertia("point mass \"" + name + "\"", Eigen::Vector3d(inertia.data()).asDiagonal(),
                        body(marker_name).coordinate + 3, false);
  else
    for (int d = 0; d < 3; ++d)
      parts_->add_dyad(parts_->M, inertia[d], at.rotation[d]);
}

void MachineModel::draw(const std::string &body_name, const Vector3 &position, double radius, const Vector3 &size)
{
  for (Body &body : parts_->bodies)
    if (body.name == body_name)
    {
      body.position = position;
      if ((body.kind == BodyKind::rotor || body.kind == BodyKind::slider) && position != Vector3{} &&
          !parts_->moves_with_frame(body.marker))
        body.centre = parts_->positions[body.name] = position; // no interface gives its position
      body.radius = radius;
      body.size   = size;
      return;
    }
  body(body_name); // throws with the nearest name
}

void MachineModel::draw_rod(const DrawnRod &rod)
{
  parts_->rods.push_back(rod);
}

void MachineModel::draw_bar(const DrawnBar &bar)
{
  parts_->bars.push_back(bar);
}

void MachineModel::draw_pin(const DrawnPin &pin)
{
  parts_->pins.push_back(pin);
}

void MachineModel::draw_point(const std::string &name, const Vector3 &at)
{
  for (Body &body : parts_->bodies)
    if (body.name == name)
      body.points.push_back(at);
}

} // namespace gestell::coupling
