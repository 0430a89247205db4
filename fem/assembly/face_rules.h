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

/// Rules on faces, exact for masses of plane ones, by the finite elements and quadratures of deal.II; computed once.
struct FaceRules
{
  std::vector<FacePoint<6>> triangle;      ///< exact to degree 5
  std::vector<FacePoint<9>> quadrilateral; ///< 3 x 3 Gauss points
};
const FaceRules &face_rules();

/// The same on each of 16 equal parts of a face, for functions that are smooth between lines across it.
const FaceRules &fine_face_rules();

} // namespace gestell::fem
