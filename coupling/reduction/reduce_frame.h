#pragma once

#include "coupling/frame/reduced_frame.h"
#include "coupling/frame/reduction_options.h"
#include "coupling/reduction/shapes/reduction_basis.h"

namespace gestell::coupling
{

/// The frame in the coordinates p of q = T p, and T itself.
struct ReducedModel
{
  ReducedFrame   frame;
  ReductionBasis basis;
};

/**
 * Reduces a frame by the method that options name (Reductions): T of the method, one projection and one estimate of
 * what the model leaves out for all.
 *
 * @param frame   M, B, C [n x n] symmetric, both triangles stored; C22 positive definite (nothing of the frame may move
 *                freely while the interface is held); interfaces may be none if modes are kept.
 * @param options 0 <= n_modes <= n - n1 or < 0; tolerance > 0; frequency >= 0 [Hz].
 * @throws std::invalid_argument (sizes, free motions, names), ConvergenceFailure (eigenvalue solver).
 */
ReducedModel reduce_with_basis(const fem::FrameMatrices &frame, const ReductionOptions &options,
                               const Progress &progress = {});

/// The frame alone.
ReducedFrame reduce_frame(const fem::FrameMatrices &frame, const ReductionOptions &options,
                          const Progress &progress = {});

} // namespace gestell::coupling
