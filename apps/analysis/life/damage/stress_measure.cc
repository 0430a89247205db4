#include "apps/analysis/life/damage/stress_measure.h"

#include <Eigen/Geometry>

#include <cmath>
#include <stdexcept>

namespace gestell::apps
{

namespace
{

using Eigen::Vector3d;

constexpr double right_angle = 1.57079632679489662;
constexpr int planes_of_turn = 18; // of 180 degrees: half a step off, the normal stress lacks sin^2 5 degrees = 0.8 %

/// a.sigma.b = row.sigma.
Eigen::Matrix<double, 1, 6> row_of(const Vector3d &a, const Vector3d &b)
{
  return (Eigen::Matrix<double, 1, 6>() << a.x() * b.x(), a.y() * b.y(), a.z() * b.z(), a.x() * b.y() + a.y() * b.x(),
          a.y() * b.z() + a.z() * b.y(), a.x() * b.z() + a.z() * b.x())
      .finished();
}

MeasureRows planes_across_surface(const Vector3d &normal)
{
  const Vector3d u = normal.unitOrthogonal(), v = normal.cross(u);
  MeasureRows    rows(planes_of_turn, 6);
  for (int i = 0; i < planes_of_turn; ++i)
  {
    const double   angle = i * step_of_planes;
    const Vector3d n     = std::cos(angle) * u + std::sin(angle) * v;
    rows.row(i)          = row_of(n, n);
  }
  return rows;
}

/// Rings of latitude a step apart, on each of which planes are at most a step apart.
MeasureRows planes_of_hemisphere()
{
  std::vector<Vector3d> normals;
  const double          step  = step_of_planes;
  const int             rings = planes_of_turn / 2;
  for (int i = 0; i <= rings; ++i)
  {
    const double polar = i * step;
    const double turn  = i == rings ? 2. * right_angle : 4. * right_angle; // the equator has every plane twice
    const int    count = std::max(1, static_cast<int>(std::ceil(turn * std::sin(polar) / step - 1e-9)));
    for (int k = 0; k < count; ++k)
      normals.emplace_back(std::sin(polar) * std::cos(k * turn / count), std::sin(polar) * std::sin(k * turn / count),
                           std::cos(polar));
  }
  MeasureRows rows(normals.size(), 6);
  for (std::size_t i = 0; i < normals.size(); ++i)
    rows.row(Eigen::Index(i)) = row_of(normals[i], normals[i]);
  return rows;
}

} // namespace

MeasureRows measure_rows(StressMeasure measure, const SurfaceDirections &at)
{
  if (measure == StressMeasure::critical_plane)
  {
    static const MeasureRows hemisphere = planes_of_hemisphere();
    return at.normal.isZero() ? hemisphere : planes_across_surface(at.normal);
  }
  const Vector3d across = at.normal.cross(at.weld);
  if (across.isZero())
    throw std::invalid_argument("the stress across or along a weld needs its direction and the normal of its surface; "
                                "name the weld line, or use the critical plane.");
  return row_of(across.normalized(), measure == StressMeasure::normal ? across.normalized() : at.weld.normalized());
}

Eigen::Matrix<double, 1, 6> normal_stress_row(const Vector3d &n)
{
  return row_of(n, n);
}

Vector3d plane_normal(const Eigen::Matrix<double, 1, 6> &row)
{
  Eigen::Matrix3d N; // n n^T
  N << row[0], row[3] / 2., row[5] / 2., row[3] / 2., row[1], row[4] / 2., row[5] / 2., row[4] / 2., row[2];
  Eigen::Index largest;
  N.diagonal().maxCoeff(&largest);
  return N(largest, largest) > 0. ? Vector3d(N.col(largest) / std::sqrt(N(largest, largest))) : Vector3d::Zero();
}

double signed_von_mises(const coupling::Stress &sigma)
{
  const double sigma_v = coupling::von_mises(sigma);
  return sigma.head<3>().sum() < -trace_of_rounding * sigma_v ? -sigma_v : sigma_v;
}

Eigen::Matrix<double, 1, 6> signed_von_mises_row(const coupling::Stress &sigma)
{
  const double                sigma_v = signed_von_mises(sigma);
  Eigen::Matrix<double, 1, 6> row     = Eigen::Matrix<double, 1, 6>::Zero();
  if (sigma_v == 0.)
    return row;
  // sigma_v^2 = 3/2 s:s, so that d sigma_v = 3/2 (s : d sigma) / sigma_v, shears twice
  row = 1.5 * sigma.transpose() / sigma_v;
  row.head<3>() -= Eigen::RowVector3d::Constant(0.5 * sigma.head<3>().sum() / sigma_v);
  row.tail<3>() *= 2.;
  return row;
}

} // namespace gestell::apps
