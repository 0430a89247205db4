#pragma once

#include "coupling/frame/reduced_frame.h"
#include "coupling/substructures/frame_of_parts.h"

#include <Eigen/Core>

#include <vector>

namespace gestell::coupling
{

/**
 * The description with what each part needs for its geometric stiffness: the motion of its interfaces and its weight,
 * and the tensions of the rods. Tie rods are tightened at constant force, weight also loads their elasticity:
 *
 *     q_0 = factor (tightened() + C^-1 G^T f_g),     T_r = factor (F_r + K_r R_r C^-1 G^T f_g).
 *
 * @param parts  reduced without prestress, in their own coordinates; static deflections of their interfaces are exact.
 * @throws std::invalid_argument for loads of zero, and for weight without supports.
 *
 * Source: docs/theory/prestress.md.
 */
FrameOfParts prestressed(FrameOfParts frame, const std::vector<ReducedFrame> &parts);

/**
 * A bound lambda of the buckling factor of the joined frame: with the stiffness S of its interfaces, the interior of
 * the parts in equilibrium,
 *
 *     (S + lambda (S' - S)) x = 0,     S without prestress, S' with it.
 *
 * S as a function of the load factor is concave, so that the frame buckles at lambda or earlier: to second order in the
 * loads where parts bend between their interfaces. Their own buckling with fixed interfaces is another bound.
 *
 * @param parts, stressed_parts  in their own coordinates.
 * @throws std::invalid_argument for a factor of 1 or less.
 */
double buckling_bound(const FrameOfParts &frame, const std::vector<ReducedFrame> &parts, const FrameOfParts &stressed,
                      const std::vector<ReducedFrame> &stressed_parts);

/// Smallest positive lambda of  (S + lambda K) x = 0  with symmetric dense matrices, S positive definite; or infinite.
double dense_buckling_factor(const Eigen::MatrixXd &S, const Eigen::MatrixXd &K);

} // namespace gestell::coupling
