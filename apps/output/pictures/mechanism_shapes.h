#pragma once

#include "apps/output/pictures/shape.h"
#include "apps/output/values/scenery.h"

namespace gestell::apps
{

/**
 * Shapes of bodies, rods and joints at the machine's coordinates q.
 *
 * A rotor is a disc at its carrier with a rib that shows its angle; a slider is a box; a rod is a bar from the pin of
 * its crank to its slider.  At angle 0 the pin points against the motion of the slider (top dead centre); the rib of a
 * rotor without a rod points along global z, or along x if z is its axis.  With crank radius r and rod length l the
 * ideal position of a slider is
 *
 *     u(phi) = -r cos phi + sqrt(l^2 - r^2 sin^2 phi) - (l - r).
 *
 * Rotors and sliders without a size are not drawn.
 *
 * A planar body with displacements u1, u2 and angle phi is a plate through its centre of mass c and the points x0 where
 * joints and measures are attached, of half breadth `radius`, or a box of `size`. Its rotation may be large:
 *
 *     x = c + u1 e_1 + u2 e_2 + R(axis, phi) (x0 - c).
 *
 * A body with a CAD part (Scenery::parts) is drawn as that part: x = c + u + R (x0 - c). The part of a rotor rotates
 * about its axis and moves with its carrier; that of a slider moves along its guide.
 *
 * A point mass is a sphere of `radius` or a box. Bodies without a size in the scene are drawn in proportion to
 * Scenery::size(). Distance joints are round bars between their markers; all pins of revolute joints form one shape,
 * "joints". Shape::points contains the whole motion of point masses and planar bodies; the motion of the frame at
 * markers is in Shape::displacement.
 */
std::vector<Shape> mechanism_shapes(const Scenery &scenery, const Eigen::VectorXd &q);

} // namespace gestell::apps
