#pragma once

#include "apps/output/pictures/shape.h"
#include "apps/output/values/scenery.h"

namespace gestell::apps
{

/**
 * Bodies, rods and joints for the machine's coordinates q.
 *
 * A rotor is a disc at its carrier, turned by its angle, with a rib that shows the angle; a slider is a box; a rod is
 * a bar from the pin of its crank to its slider.  At angle 0 the pin points against the motion of the slider (top dead
 * centre); rotors without a rod start at global z, or x where z is their axis.  With crank radius r and rod length l
 * the ideal position of a slider is
 *
 *     u(phi) = -r cos phi + sqrt(l^2 - r^2 sin^2 phi) - (l - r).
 *
 * Rotors and sliders of no size are left out.
 *
 * A planar body of displacements u1, u2 and angle phi is a plate through its centre of mass c and the points x0 where
 * joints and measures take hold of it, with half the breadth `radius`, or a box of `size`; it keeps its form at any
 * angle:
 *
 *     x = c + u1 e_1 + u2 e_2 + R(axis, phi) (x0 - c).
 *
 * A body with a part (Scenery::parts) is drawn as that: x = c + u + R (x0 - c), of a rotor about its axis and with its
 * carrier, of a slider along its way.
 *
 * A point is a sphere of `radius` or a box.  What a scene gives no size is drawn in proportion to Scenery::size().
 * Distance joints are round bars between their places, all pins of revolute joints one shape, "joints".  The position
 * of points and planar bodies holds all of their motion; of places the motion of the frame is displacement.
 */
std::vector<Shape> mechanism_shapes(const Scenery &scenery, const Eigen::VectorXd &q);

} // namespace gestell::apps
