#pragma once

#include "coupling/reduction/shapes/reduction_basis.h"
#include "fem/values/frame_matrices.h"

#include <Eigen/Core>

namespace gestell::coupling
{

/**
 * Motions without stiffness of the frame with nothing held [n x k].
 *
 * A frame that knows its rigid motions is asked for them, for the softest eigenvalues of S may lie no higher than
 * rounding: those of a thin chassis that bends, or of one interface alone.  Of others, such as imported matrices, those
 * below 1e-11 count, S scaled to unit diagonal.
 *
 * @param S  C*_11 [n1 x n1].
 */
Eigen::MatrixXd motions_without_stiffness(const Eigen::MatrixXd &S, const ReductionBasis &basis,
                                          const fem::FrameMatrices &frame);

/// S^+ on the complement of its null vectors Z [n1 x k]: what rounding leaves of S along them is cut off.
Eigen::MatrixXd inverse_beside(const Eigen::MatrixXd &S, const Eigen::MatrixXd &Z);

} // namespace gestell::coupling
