#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace gestell::fem
{

/**
 * Integrals over a volume V of density one, about an origin that stays:
 *
 *     V = int dV,   first = int x dV,   second = int x x^T dV.
 *
 * Of a tetrahedron with corners x_i and s = sum x_i they are exact:  V s/4  and  V/20 (sum x_i x_i^T + s s^T).
 */
struct VolumeIntegrals
{
  double          volume = 0.;
  Eigen::Vector3d first  = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();

  /// Positively oriented corners add, others subtract: tetrahedra from one point to the triangles of a closed surface
  /// sum up to the volume it encloses.
  void add_tetrahedron(const Eigen::Vector3d &a, const Eigen::Vector3d &b, const Eigen::Vector3d &c,
                       const Eigen::Vector3d &d)
  {
    const double          V = (b - a).dot((c - a).cross(d - a)) / 6.;
    const Eigen::Vector3d s = a + b + c + d;
    volume += V;
    first += 0.25 * V * s;
    second +=
        V / 20. * (a * a.transpose() + b * b.transpose() + c * c.transpose() + d * d.transpose() + s * s.transpose());
  }

  /// A body of volume V, its centre, and its tensor of inertia about it, int (r.r I - r r^T) dV.
  void add_body(double V, const Eigen::Vector3d &centre, const Eigen::Matrix3d &inertia)
  {
    volume += V;
    first += V * centre;
    second += 0.5 * inertia.trace() * Eigen::Matrix3d::Identity() - inertia + V * centre * centre.transpose();
  }

  Eigen::Vector3d centre() const { return first / volume; }

  /// Tensor of inertia about the centre [m^5].
  Eigen::Matrix3d inertia() const
  {
    const Eigen::Matrix3d S = second - volume * centre() * centre().transpose();
    return S.trace() * Eigen::Matrix3d::Identity() - S;
  }
};

} // namespace gestell::fem
