#pragma once

#include "coupling/reduction/shapes/reduction_basis.h"
#include "fem/values/frame_matrices.h"

#include <Eigen/Core>

namespace gestell::coupling
{

/**
 * Motions without stiffness of the unconstrained frame [n x k].
 *
 * The rigid-body modes of the frame are used if they are known, because the softest eigenvalues of S may be as small as
 * rounding errors: for a thin chassis in bending, or with only one interface.  For other frames, such as imported
 * matrices, motions with eigenvalues below 1e-11 are used, S scaled to unit diagonal.
 *
 * @param S  C*_11 [n1 x n1].
 */
Eigen::MatrixXd motions_without_stiffness(const Eigen::MatrixXd &S, const ReductionBasis &basis,
                                          const fem::FrameMatrices &frame);

/// Whether a motion may be free; if not, the search through C is saved.
bool may_move_freely(const Eigen::MatrixXd &S);

/// S^+ on the complement of its null vectors Z [n1 x k]: the rounding errors of S along them are removed.
Eigen::MatrixXd inverse_beside(const Eigen::MatrixXd &S, const Eigen::MatrixXd &Z);

} // namespace gestell::coupling
