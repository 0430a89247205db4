#pragma once

#include <Eigen/Core>

#include <vector>

namespace gestell::fem
{

/// A point of a quadrature rule on the triangle of 6 nodes or the quadrilateral of 9.
template <int n>
struct FacePoint
{
  double                      weight = 0.;
  Eigen::Matrix<double, n, 1> N      = Eigen::Matrix<double, n, 1>::Zero();
  Eigen::Matrix<double, n, 2> dN     = Eigen::Matrix<double, n, 2>::Zero(); ///< dN_a / dxi_d
};

/// Integrals over the reference tetrahedron (volume 1/6) and triangle (area 1/2) of quadratic shape functions N_a.
struct ReferenceIntegrals
{
  Eigen::Matrix<double, 10, 10> mass;              ///< int N_a N_b dV
  Eigen::Matrix3d               gradients[10][10]; ///< int (dN_a/dxi) (dN_b/dxi)^T dV
  Eigen::Matrix<double, 6, 6>   triangle_mass;     ///< int N_a N_b dA

  std::vector<FacePoint<6>> triangle;      ///< exact to degree 5
  std::vector<FacePoint<9>> quadrilateral; ///< 3 x 3 Gauss points
};

/// Computed once by the finite elements and quadratures of deal.II, exact for these polynomials (degree 4).
const ReferenceIntegrals &reference_integrals();

} // namespace gestell::fem
