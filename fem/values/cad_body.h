#pragma once

#include <Eigen/Core>

#include <array>
#include <string>
#include <vector>

namespace gestell::fem
{

/// Integrals over the volume of a body, in the coordinates of its file and for density one.
struct CadBody
{
  std::vector<std::string> solids;                            ///< names; their integrals are summed
  double                   volume  = 0.;                      ///< [m^3]
  Eigen::Vector3d          centre  = Eigen::Vector3d::Zero(); ///< of volume [m]
  Eigen::Matrix3d          inertia = Eigen::Matrix3d::Zero(); ///< about the centre, int (r.r I - r r^T) dV [m^5]

  /// Skin for pictures; empty if gmsh cannot mesh the surfaces.
  std::vector<std::array<double, 3>> points;    ///< [m]
  std::vector<std::array<int, 3>>    triangles; ///< outside counter-clockwise
};

} // namespace gestell::fem
