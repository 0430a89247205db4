#include "apps/output/values/scenery.h"

#include <Eigen/Geometry>

namespace gestell::apps
{

namespace
{
Eigen::Vector3d vector(const std::array<double, 3> &x)
{
  return {x[0], x[1], x[2]};
}
} // namespace

double Scenery::size() const
{
  using coupling::BodyKind;
  Eigen::AlignedBox3d box;
  for (const auto &x : points)
    box.extend(vector(x));
  for (const auto &interface : interface_positions)
    box.extend(vector(interface.second));
  for (const coupling::Body &body : bodies)
  {
    const bool free = body.kind != BodyKind::rotor && body.kind != BodyKind::slider;
    if (!free && !(body.radius > 0.) && !(vector(body.size).minCoeff() > 0.))
      continue;
    const Eigen::Vector3d half = Eigen::Vector3d::Constant(body.radius) + 0.5 * vector(body.size);
    box.extend(vector(body.position) - half);
    box.extend(vector(body.position) + half);
    for (const auto &x : body.points)
      box.extend(vector(x));
  }
  for (const DrawnPart &part : parts)
    for (const auto &x : part.points)
      box.extend(vector(x));
  for (const coupling::DrawnBar &bar : bars)
    for (const coupling::PlacedPoint *end : {&bar.from, &bar.to})
      box.extend(end->placement.point());
  const double diagonal = box.isEmpty() ? 0. : box.diagonal().norm();
  return diagonal > 0. ? diagonal : 1.;
}

double value(const coupling::Measure &measure, const Eigen::VectorXd &q)
{
  double u = 0.;
  for (const auto &[coordinate, weight] : measure)
    u += weight * q(coordinate);
  return u;
}

Eigen::Vector3d translation(const coupling::Marker &marker, const Eigen::VectorXd &q)
{
  return {value(marker.translation[0], q), value(marker.translation[1], q), value(marker.translation[2], q)};
}

namespace
{
std::array<double, mechanism::Placement::max_measures> measures(const coupling::PlacedPoint &place,
                                                                const Eigen::VectorXd       &q)
{
  std::array<double, mechanism::Placement::max_measures> u{};
  for (std::size_t i = 0; i < place.measures.size(); ++i)
    u[i] = value(place.measures[i], q);
  return u;
}
} // namespace

Eigen::Vector3d position(const coupling::PlacedPoint &place, const Eigen::VectorXd &q)
{
  return place.placement.position(measures(place, q).data());
}

Eigen::Vector3d direction(const coupling::PlacedPoint &place, const Eigen::Vector3d &e, const Eigen::VectorXd &q)
{
  return place.placement.direction(e, measures(place, q).data());
}

} // namespace gestell::apps
