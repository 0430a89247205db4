#include "apps/session/forces/acting_forces.h"

#include <Eigen/Geometry>
#include <Eigen/QR>

#include <memory>

namespace gestell::apps
{

namespace
{

using coupling::PlacedPoint;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// Force and torque about a place [N, N m], and how many translations of it the coordinates know.
struct Wrench
{
  Vector3d force = Vector3d::Zero(), torque = Vector3d::Zero();
  int      translations = 0;
};

VectorXd measures_of(const PlacedPoint &place, const VectorXd &q)
{
  VectorXd w(Eigen::Index(place.measures.size()));
  for (std::size_t i = 0; i < place.measures.size(); ++i)
    w[Eigen::Index(i)] = value(place.measures[i], q);
  return w;
}

bool turns_in_space(const PlacedPoint &place)
{
  return place.placement.n_measures() == mechanism::Placement::max_measures &&
         !place.placement.is_linear(mechanism::Placement::max_measures - 1) && !place.placement.turns();
}

/// Translations and rotations [6 x measures] of a place: x' and omega of a unit rate of each measure.
MatrixXd motions(const PlacedPoint &place, const VectorXd &w)
{
  mechanism::Placement::MovedVector x;
  place.placement.position(w.data(), nullptr, x);
  MatrixXd all(6, w.size());
  all.topRows(3) = x.J;
  for (int i = 0; i < int(w.size()); ++i)
    all.block<3, 1>(3, i) = place.placement.rotation(i);
  return all;
}

/// dw/dq of the named coordinates [measures x coordinates].
MatrixXd rates(const PlacedPoint &place, const std::vector<int> &coordinates)
{
  MatrixXd of = MatrixXd::Zero(Eigen::Index(place.measures.size()), Eigen::Index(coordinates.size()));
  for (std::size_t i = 0; i < place.measures.size(); ++i)
    for (const auto &[coordinate, weight] : place.measures[i])
    {
      const auto at = std::lower_bound(coordinates.begin(), coordinates.end(), coordinate);
      if (at != coordinates.end() && *at == coordinate)
        of(Eigen::Index(i), at - coordinates.begin()) += weight;
    }
  return of;
}

/// For a free spatial body, from its rigid-body motions: a unit rotation about e moves d_i by e x d_i.
Wrench of_free_body(const PlacedPoint &place, const VectorXd &w, const VectorXd &g)
{
  Wrench found{g.head<3>(), Vector3d::Zero(), 3};
  for (int i = 0; i < 3; ++i)
  {
    const Vector3d director = Vector3d::Unit(i) + w.segment<3>(3 + 3 * i);
    found.torque += director.cross(Vector3d(g.segment<3>(3 + 3 * i)));
  }
  // (x - c) = sum rho_i d_i with the directors; rho from the motion of x by each of them
  mechanism::Placement::MovedVector moved;
  place.placement.position(w.data(), nullptr, moved);
  Vector3d arm = Vector3d::Zero();
  for (int i = 0; i < 3; ++i)
    arm += moved.J(0, 3 + 3 * i) * (Vector3d::Unit(i) + w.segment<3>(3 + 3 * i));
  found.torque -= arm.cross(found.force);
  return found;
}

/// @param Q  [n] W p
Wrench wrench_on(const ForceSide &side, const VectorXd &q, const VectorXd &Q, double size)
{
  if (side.own.empty())
    return {};
  const VectorXd w     = measures_of(side.at, q);
  const MatrixXd dw_dq = rates(side.at, side.own);
  const VectorXd own   = Q(side.own);
  if (turns_in_space(side.at) && side.own.size() == 12)
    return of_free_body(side.at, w, dw_dq * own); // a permutation
  MatrixXd moves = motions(side.at, w) * dw_dq;   // [6 x own]
  moves.bottomRows(3) *= size;                    // torques over it, in N
  Eigen::ColPivHouseholderQR<MatrixXd> translations(moves.topRows(3));
  constexpr double                     full = 1e-9; // relative size of a pivot: rounding of places
  translations.setThreshold(full);
  const VectorXd solution = MatrixXd(moves.transpose()).completeOrthogonalDecomposition().solve(own);
  return {solution.head<3>(), size * solution.tail<3>(), int(translations.rank())};
}

/// The reaction on the other body.
Wrench reaction(const Wrench &to, const Vector3d &from_place, const Vector3d &at_place, int translations)
{
  return {-to.force, -to.torque - (from_place - at_place).cross(to.force), translations};
}

VectorXd on_coordinates(const ForceBetween &between, const VectorXd &p, Eigen::Index n)
{
  VectorXd Q = VectorXd::Zero(n);
  for (std::size_t i = 0; i < between.measures.size(); ++i)
    for (const auto &[coordinate, weight] : between.measures[i])
      Q[coordinate] += weight * p[between.first_measure + Eigen::Index(i)];
  return Q;
}

/// Only the motion of the bodies.
VectorXd without_frame(const VectorXd &q, int n_frame)
{
  VectorXd bodies = q;
  bodies.head(n_frame).setZero();
  return bodies;
}

ActingForce acting(const std::string &name, const std::string &body, const PlacedPoint &place, const VectorXd &q,
                   const VectorXd &bodies, const Wrench &wrench)
{
  const Vector3d at = position(place, bodies);
  return {name, body, at, position(place, q) - at, wrench.force, wrench.torque};
}

void add_between(const ForceBetween &between, const VectorXd &q, const VectorXd &bodies, const VectorXd &p,
                 std::vector<ActingForce> &all)
{
  const VectorXd Q   = on_coordinates(between, p, q.size());
  const Vector3d x_1 = position(between.first.at, q), x_2 = position(between.second.at, q);
  const double   size  = std::max(1e-3, (between.first.at.placement.size() + between.second.at.placement.size()) / 2.);
  Wrench         first = wrench_on(between.first, q, Q, size), second = wrench_on(between.second, q, Q, size);
  if (between.is_load)
  {
    all.push_back(acting(between.name, between.second.body, between.second.at, q, bodies, second));
    return;
  }
  const bool by_first  = first.translations > second.translations || between.second.own.empty();
  const bool by_second = second.translations > 0 || between.first.own.empty();
  if (!between.is_coupling && by_first)
    second = reaction(first, x_1, x_2, second.translations);
  else if (!between.is_coupling && by_second)
    first = reaction(second, x_2, x_1, first.translations);
  all.push_back(acting(between.name, between.first.body, between.first.at, q, bodies, first));
  all.push_back(acting(between.name, between.second.body, between.second.at, q, bodies, second));
}

/// All of a force on the body except the torque about its axis of rotation, or the force along its sliding direction;
/// about the reference point of the body.
Wrench passed_on(const Bearing &bearing, const ActingForce &force, const VectorXd &q)
{
  const Vector3d arm = force.at + force.displacement - position(bearing.of_body, q);
  Wrench         passed{force.force, force.torque + arm.cross(force.force), 0};
  Vector3d      &own = bearing.turns ? passed.torque : passed.force;
  own -= bearing.axis.dot(own) * bearing.axis;
  return passed;
}

/// Adds the forces of bearings and guides on the two bodies that they connect, after the forces between points.
void add_bearings(const std::vector<Bearing> &bearings, const VectorXd &q, const VectorXd &bodies,
                  std::vector<ActingForce> &all)
{
  const auto pass_on = [&](const ActingForce &force, const auto &further) -> void
  {
    for (const Bearing &bearing : bearings)
      if (bearing.body == force.body)
      {
        const Wrench passed = passed_on(bearing, force, q);
        all.push_back(acting(force.name, bearing.body, bearing.of_body, q, bodies,
                             {-passed.force, -passed.torque, passed.translations}));
        const ActingForce on_carrier = acting(force.name, bearing.carrier, bearing.of_carrier, q, bodies, passed);
        all.push_back(on_carrier);
        further(on_carrier, further);
      }
  };
  const std::vector<ActingForce> between = all;
  for (const ActingForce &force : between)
    pass_on(force, pass_on);
}

} // namespace

ActingForces::ActingForces(const Scene &scene, const coupling::Machine &machine)
    : machine_(machine), places_(force_places(scene, machine))
{
}

std::vector<ActingForce> ActingForces::at(double t, const VectorXd &q, const VectorXd &v, const VectorXd &p) const
{
  std::vector<ActingForce> all;
  const VectorXd           bodies = without_frame(q, machine_.model().n_frame());
  for (const ForceBetween &between : places_.between)
    add_between(between, q, bodies, p, all);
  add_bearings(places_.bearings, q, bodies, all);
  coupling::LocalState local;
  local.resize(machine_);
  local.t = t;
  for (const ForceAlong &along : places_.along)
  {
    const double F = along.measure >= 0 ? p[along.measure] : along.sign * machine_.evaluate(along.signal, q, v, local);
    const Vector3d acts = F * along.direction;
    all.push_back(acting(along.name, along.body, along.at, q, bodies,
                         along.turns ? Wrench{Vector3d::Zero(), acts, 0} : Wrench{acts, Vector3d::Zero(), 0}));
  }
  return all;
}

std::function<std::vector<ActingForce>(double, const VectorXd &, const VectorXd &, const VectorXd &)>
forces_in_space(const Scene &scene, const coupling::Machine &machine)
{
  const auto forces = std::make_shared<ActingForces>(scene, machine);
  return [forces](double t, const VectorXd &q, const VectorXd &v, const VectorXd &p) { return forces->at(t, q, v, p); };
}

} // namespace gestell::apps
