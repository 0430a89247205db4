#pragma once

#include <Eigen/Core>

#include <array>
#include <string>
#include <vector>

namespace gestell::apps
{

/// A body as drawn.  `points` follow from ideal kinematics; the contributions of elasticity, clearance and the moving
/// frame are in `displacement`, so that bodies remain attached to a frame whose small displacements are drawn enlarged.
struct Shape
{
  std::string                     name;
  std::vector<Eigen::Vector3d>    points;       ///< [m]
  std::vector<Eigen::Vector3d>    displacement; ///< [m] of each point
  std::vector<std::array<int, 3>> triangles;    ///< into points, outside counter-clockwise
};

/// Unit vector normal to the unit vector `axis`, as close to `wish` as possible.
Eigen::Vector3d across(const Eigen::Vector3d &axis, const Eigen::Vector3d &wish);

/// Adds a box about `centre` with half edges a, b, c (a right-handed frame).
void add_box(Shape &shape, const Eigen::Vector3d &centre, const Eigen::Vector3d &a, const Eigen::Vector3d &b,
             const Eigen::Vector3d &c);

/// Adds a prism: the convex outline, counter-clockwise about the unit vector n, moved from -half n to half n.
void add_prism(Shape &shape, const std::vector<Eigen::Vector3d> &outline, const Eigen::Vector3d &half);

/// Adds a disc about `centre` normal to `axis`; its first corner is in direction e1.
void add_disc(Shape &shape, const Eigen::Vector3d &centre, const Eigen::Vector3d &e1, const Eigen::Vector3d &axis,
              double radius, double half_width);

/// Adds a round bar from a to b with `n_corners` corners; a and b must be distinct.
void add_bar(Shape &shape, const Eigen::Vector3d &a, const Eigen::Vector3d &b, double radius, int n_corners = 12);

/// Adds a sphere of n_rings >= 2 bands from pole to pole: 2 n_rings (n_rings - 1) + 2 points.
void add_sphere(Shape &shape, const Eigen::Vector3d &centre, double radius, int n_rings = 8);

/// Adds a plate with round corners.  In the plane normal to the unit vector n it covers all points within `radius` of
/// the convex hull of `points`; along n it extends `half_width` beyond the lowest and the highest point.
void add_plate(Shape &shape, const std::vector<Eigen::Vector3d> &points, const Eigen::Vector3d &n, double radius,
               double half_width);

} // namespace gestell::apps
