#pragma once

#include <Eigen/Core>

#include <vector>

namespace gestell::fem
{

/**
 * A plane face and the displacement fields over it that an interface may have in addition to its rigid motion,
 *
 *     u(x) = u_0 + theta x (x - x_0) + sum_k a_k phi_k(x),     xi = e_1 (x - c)/h_1,   eta = e_2 (x - c)/h_2,
 *
 * phi_k = e_c P_i(xi) P_j(eta) with Legendre polynomials, i + j <= p, without the six rigid motions: for degree 1 two
 * stretches and the shear in the plane remain.  Together they are all polynomials of degree p, for any directions of
 * e_1 and e_2 in the plane, 3 (p + 1)(p + 2)/2 - 6 fields.
 */
struct PlaneFace
{
  Eigen::Vector3d centre = Eigen::Vector3d::Zero(); ///< c, of the rectangle or box around it [m]
  /// Columns e_1, e_2, outward normal; for faces that are not plane half of the sides of the box around them [m].
  Eigen::Matrix3d  axes   = Eigen::Matrix3d::Zero();
  Eigen::Vector2d  half   = Eigen::Vector2d::Zero(); ///< h_1, h_2: half its sides [m]
  int              degree = 0;                       ///< p; 0: only the rigid motion
  std::vector<int> coordinate;                       ///< a_k in q

  bool known() const { return half[0] > 0.; }
  /// Whether the rectangles of two coplanar faces have a common area.
  bool overlaps(const PlaneFace &other) const;
};

/// 3 (p + 1)(p + 2)/2 - 6, or 0 for degree 0.
int n_fields(int degree);

/// P_i(xi) P_j(eta), i + j <= p, by ascending i + j [(p + 1)(p + 2)/2].
Eigen::RowVectorXd polynomials_at(const PlaneFace &face, const Eigen::Vector3d &x);

/// phi_k(x) [3 x n_fields].
Eigen::Matrix3Xd fields_at(const PlaneFace &face, const Eigen::Vector3d &x);

/// The rectangle around points of a plane with a known outward normal; unknown if the distance of points from the plane
/// exceeds 1e-6 of their extent.
/// @param normal  unit vector, or zero: the face is not plane.
PlaneFace plane_face(const Eigen::Matrix3Xd &points, const Eigen::Vector3d &normal);

} // namespace gestell::fem
