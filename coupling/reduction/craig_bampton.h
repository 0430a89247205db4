#pragma once

#include "coupling/frame/reduced_frame.h"
#include "coupling/frame/reduction_options.h"
#include "coupling/reduction/shapes/reduction_basis.h"

namespace gestell::coupling
{

/**
 * Fixed-interface reduction of a linear frame (Craig-Bampton, after Kaltofen 5.5.3/14-23).
 *
 *     q = [ q1 ]  =  T p,     T = [     E          0  ]
 *         [ q2 ]                  [ -C22^-1 C21   V22 ]
 *
 * q1, the coordinates of all interfaces, stays physical, so mechanisms attach to it unchanged; deflection under static
 * interface loads is exact for any number of modes.  One Cholesky factor of C22 serves all steps.
 *
 * A modal damping ratio zeta refers to the modes of the supported frame with free interface, refined (RefinedModes),
 * and enters as  B* = T^T B T + P diag(2 zeta omega) P^T,  P = T^T M Phi: what add_modal_damping() does to a full
 * frame.
 *
 * Automatic number of modes (options.n_modes < 0): see select_modes().
 *
 * @param frame   M, B, C [n x n] symmetric, both triangles stored; C22 positive definite (nothing of the frame may move
 *                freely while the interface is held); interfaces may be none.
 * @param options 0 <= n_modes <= n - n1 (0 gives Guyan's reduction) or < 0; tolerance > 0; frequency >= 0 [Hz].
 * @throws std::invalid_argument (sizes, free motions), ConvergenceFailure (eigenvalue solver).
 *
 * Source: Craig & Bampton, AIAA Journal 6(7), 1968, 1313-1319; docs/theory/reduction.md.
 */
ReducedFrame craig_bampton(const fem::FrameMatrices &frame, const ReductionOptions &options,
                           const Progress &progress = {});

/// The same, and T itself.
struct Reduction
{
  ReducedFrame   frame;
  ReductionBasis basis;
};
Reduction craig_bampton_with_basis(const fem::FrameMatrices &frame, const ReductionOptions &options,
                                   const Progress &progress = {});

/// T itself with exactly the lowest n_modes modes, of which none is missing, for those who need the internal
/// coordinates back.
ReductionBasis craig_bampton_basis(const fem::FrameMatrices &frame, int n_modes);

/// Fills frame.modal_damping with the lowest n_modes modes of the supported frame (rigid motions are not damped):
/// Z = M Phi, d = 2 zeta omega with zeta = frame.modal_damping_ratio.  That none is missing is proved by inertia, see
/// FixedInterfaceModes.
/// @throws std::invalid_argument if the frame is not supported or has fewer coordinates; ConvergenceFailure.
void add_modal_damping(fem::FrameMatrices &frame, int n_modes, const Progress &progress = {});

} // namespace gestell::coupling
