#pragma once

#include "coupling/frame/reduced_frame.h"
#include "coupling/substructures/part_union.h"

#include <Eigen/Core>

#include <vector>

namespace gestell::coupling
{

/**
 * How much too high the frequencies of the joined frame are because parts keep some of their fixed-interface modes
 * only.  To first order, a mode phi (phi^T M phi = 1) of frequency omega moves the interfaces of part i by q_1, and its
 * modes left out, of frequencies omega_j >= omega_c and coupling masses m_j, lower it by
 *
 *     d(omega)/omega = 1/2 sum omega^2 (m_j^T q_1)^2 / (omega_j^2 - omega^2) <= 1/2 omega^2 q_1^T F q_1 / (1 - r^2),
 *     F = sum m_j m_j^T / omega_j^2,   r = omega / omega_c.
 *
 * Static shapes X of the inertia in their place take F away and leave r^4 of it.  omega_c is taken as the highest
 * frequency kept, or as the lowest of the static shapes, which comes near to that of the next mode from above.  Beyond
 * it, or of parts that do not tell F, nothing is known: NaN.
 *
 * @param omega, V  modes of the joined frame [p], [n_j x p].
 * @return          [p], >= 0.
 *
 * Source: docs/theory/substructures.md (6), (7).
 */
Eigen::VectorXd errors_by_modes_left_out(const std::vector<ReducedFrame> &parts, const PartUnion &all,
                                         const Eigen::MatrixXd &G, const Eigen::VectorXd &omega,
                                         const Eigen::MatrixXd &V);

} // namespace gestell::coupling
