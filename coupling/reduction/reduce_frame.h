#pragma once

#include "coupling/frame/reduced_frame.h"
#include "coupling/frame/reduction_options.h"
#include "coupling/reduction/shapes/reduction_basis.h"

#include <string>

namespace gestell::coupling
{

/// The frame in the coordinates p of q = T p, and T itself.
struct ReducedModel
{
  ReducedFrame    frame;
  ReductionBasis  basis;
  Eigen::MatrixXd beyond; // [n x 3] deflection under a unit acceleration that is missing in the basis, or [n x 0]
  std::string     factor; ///< of the reduction, see make_factor()
};

/**
 * Reduces a frame by the method in `options` (Reductions): T of the method, with a common projection and error
 * estimate.
 *
 * @param frame    M, B, C [n x n] symmetric, both triangles stored; C22 positive definite (no rigid-body mode with the
 * interface fixed); interfaces may be empty if modes are retained.
 * @param options  0 <= n_modes <= n - n1 or < 0; tolerance > 0; frequency >= 0 [Hz].
 * @param given    the same frame, if its M and C may be left without entries: several ranks store them, rank 0 does
 * not.
 * @throws std::invalid_argument (sizes, free motions, names), ConvergenceFailure (eigenvalue solver).
 */
ReducedModel reduce_with_basis(const fem::FrameMatrices &frame, const ReductionOptions &options,
                               const Progress &progress = {}, fem::FrameMatrices *given = nullptr);

/// The same, returning only the frame.
ReducedFrame reduce_frame(const fem::FrameMatrices &frame, const ReductionOptions &options,
                          const Progress &progress = {});

} // namespace gestell::coupling
