#pragma once

#include "apps/output/scenery.h"

#include <Eigen/Core>

#include <array>
#include <string>
#include <vector>

namespace gestell::apps
{

/// A body as drawn.  Points stand where ideal kinematics puts them; what elasticity, play and the moving frame add is
/// in `displacement`, so that bodies stay on a frame whose small displacements are drawn enlarged.
struct Shape
{
  std::string                     name;
  std::vector<Eigen::Vector3d>    points;       ///< [m]
  std::vector<Eigen::Vector3d>    displacement; ///< [m] of each point
  std::vector<std::array<int, 3>> triangles;    ///< into points, outside counter-clockwise
};

/**
 * Bodies and rods for the machine's coordinates q.
 *
 * A rotor is a disc at its carrier, turned by its angle, with a rib that shows the angle; a slider is a box; a rod is
 * a bar from the pin of its crank to its slider.  At angle 0 the pin points against the motion of the slider (top dead
 * centre); rotors without a rod start at global z, or x where z is their axis.  With crank radius r and rod length l
 * the ideal position of a slider is
 *
 *     u(phi) = -r cos phi + sqrt(l^2 - r^2 sin^2 phi) - (l - r).
 *
 * Bodies of no size are left out.
 */
std::vector<Shape> mechanism_shapes(const Scenery &scenery, const Eigen::VectorXd &q);

} // namespace gestell::apps
