#pragma once

#include "coupling/frame/reduced_frame.h"
#include "coupling/reduction/estimates/refined_modes.h"
#include "coupling/reduction/shapes/reduction_basis.h"
#include "fem/values/frame_matrices.h"

#include <Eigen/Core>

namespace gestell::coupling
{

/**
 * The frame in the coordinates p of q = T p: M*, B*, C*, loads T^T f, and the rows of outputs, pictures and stresses,
 * each the full one times T.
 *
 * A modal damping ratio zeta refers to the modes of the supported frame with free interface and enters as
 * B* = T^T B T + P diag(2 zeta omega) P^T,  P = T^T M Phi: what add_modal_damping() does to a full frame.
 *
 * @param star    of the basis.
 * @param damped  Phi.
 * @param load    [n x 3] of a unit acceleration, or [n x 0].
 * @param beyond  [n x 3] deflection under it that the basis lacks: outputs and stresses take it as it is.
 *
 * Source: (5.5.3/19 to 21); docs/theory/reduction.md (5) to (10).
 */
ReducedFrame project(const fem::FrameMatrices &frame, const ReductionBasis &basis, ReducedMatrices star,
                     const RefinedModes &damped, const Eigen::MatrixXd &load, const Eigen::MatrixXd &beyond);

/// The full frame knows how many motions are free: where one interface alone would hold it, all of C*_11 is rounding,
/// which is taken out along these motions, and their frequencies are zero.
void name_free_motions(ReducedFrame &reduced, const fem::FrameMatrices &frame, const std::vector<int> &q1);

} // namespace gestell::coupling
