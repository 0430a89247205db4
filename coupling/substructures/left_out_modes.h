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
 * modes left out, of frequencies omega_j >= omega_c, lower it by
 *
 *     d(omega)/omega = 1/2 sum_j omega^2 (m_j^T q_1)^2 / (omega_j^2 - omega^2) <= 1/2 omega^2 / (omega_c^2 - omega^2)
 *     q_1^T (M_11 - M_1L M_L1) q_1,
 *
 * since M_11 - M_1L M_L1 = sum m_j m_j^T and what the nodes of the interface weigh by themselves.  omega_c is taken as
 * the highest frequency kept; of parts that keep static shapes of their inertia in place of modes, as the lowest of
 * these.  Above it nothing is known: NaN.
 *
 * @param omega, V  modes of the joined frame [p], [n_j x p].
 * @return          [p], >= 0.
 *
 * Source: residual flexibility and mass of substructures, Castanier, Tan & Pierre 2001; docs/theory/substructures.md.
 */
Eigen::VectorXd errors_by_modes_left_out(const std::vector<ReducedFrame> &parts, const PartUnion &all,
                                         const Eigen::MatrixXd &G, const Eigen::VectorXd &omega,
                                         const Eigen::MatrixXd &V);

} // namespace gestell::coupling
