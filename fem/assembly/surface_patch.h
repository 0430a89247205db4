#pragma once

#include "fem/assembly/quadratic_mesh.h"
#include "fem/values/mesh.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <string>
#include <vector>

namespace gestell::fem
{

/// One or more named surfaces as a set of quadratic triangles; a triangle named twice is included once.
struct SurfacePatch
{
  std::vector<int>                nodes;  ///< of the quadratic mesh, ascending
  std::vector<std::array<int, 6>> faces;  ///< into the quadratic mesh; both halves of a quadrilateral
  std::vector<std::array<int, 9>> quads;  ///< quadrilaterals, FE_Q(2)
  Eigen::SparseMatrix<double>     S;      ///< int N_a N_b dA [m^2], over `nodes`
  Eigen::VectorXd                 weight; ///< int N_a dA = S 1 [m^2]; 0 at corners, a third of the area at middles
  Eigen::Matrix3Xd                normal; ///< [3 x nodes] int N_a n dA [m^2], n outward
  double                          area     = 0.;                      ///< [m^2]
  Eigen::Vector3d                 centroid = Eigen::Vector3d::Zero(); ///< of the area [m]
};

/**
 * @param owner name of the caller in messages, e.g. "interface crown"; `place` heads the message.
 * @throws std::invalid_argument for no surface, an unknown name (with the nearest ones) or a surface without area.
 */
SurfacePatch surface_patch(const Mesh &mesh, const QuadraticMesh &quadratic, const std::vector<std::string> &surfaces,
                           const std::string &owner, const std::string &place);

/// The part of a surface that consists of these faces.
SurfacePatch surface_patch(const QuadraticMesh &mesh, std::vector<std::array<int, 6>> faces);

} // namespace gestell::fem
