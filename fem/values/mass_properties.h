#pragma once

#include <Eigen/Core>

namespace gestell::fem
{

/// Mass, centre of mass and inertia tensor about it, of bodies that move together.
struct MassProperties
{
  double          mass    = 0.;                      ///< [kg]
  Eigen::Vector3d centre  = Eigen::Vector3d::Zero(); ///< [m]
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero(); ///< int (r.r I - r r^T) dm about the centre [kg m^2]

  /// Adds another body, with each tensor shifted to the common centre (Huygens and Steiner): J += J_2 + m_1 m_2 / (m_1
  /// + m_2) (d.d I - d d^T),  d the distance of the centres.
  void add(const MassProperties &other)
  {
    const double total = mass + other.mass;
    if (!(total > 0.))
      return;
    const Eigen::Vector3d d = other.centre - centre;
    inertia +=
        other.inertia + mass * other.mass / total * (d.squaredNorm() * Eigen::Matrix3d::Identity() - d * d.transpose());
    centre += other.mass / total * d;
    mass = total;
  }
};

} // namespace gestell::fem
