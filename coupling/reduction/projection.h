#pragma once

#include "coupling/frame/reduced_frame.h"
#include "coupling/reduction/shapes/fixed_interface_frame.h"
#include "coupling/reduction/shapes/reduction_basis.h"
#include "fem/values/frame_matrices.h"

#include <Eigen/Core>

namespace gestell::coupling
{

/**
 * The frame in the coordinates p of q = T p: M*, B*, C*, loads T^T f, and the rows of outputs, pictures and stresses,
 * each multiplied by T.
 *
 * Modal damping is added to the result: add_modal_damping().
 *
 * @param star    of the basis.
 * @param load    [n x 3] of a unit acceleration, or [n x 0].
 * @param beyond  [n x 3] deflection under it that is missing in the basis, added to outputs and stresses directly.
 *
 * Source: (5.5.3/19 to 21); docs/theory/reduction.md (5) to (7).
 */
ReducedFrame project(const fem::FrameMatrices &frame, const ReductionBasis &basis, ReducedMatrices star,
                     const Eigen::MatrixXd &load, const Eigen::MatrixXd &beyond);

/**
 * Balances the forces of the frame with its inertia, however few modes: to the rows of force_outputs() the static
 * answer beyond the basis to inertia and dampers is added (mode acceleration).  With rows r on q,
 *
 *     z = C22^-1 r_2 - V22 diag(1/omega_0^2) V22^T r_2,     on_a -= T^T M z,     on_v -= T^T B z.
 *
 * @param answers  [n x k] C22^-1 r_2
 *
 * Source: docs/theory/reduction.md (7a).
 */
void balance_forces(ReducedFrame &reduced, const fem::FrameMatrices &frame, const FixedInterfaceFrame &held,
                    const ReductionBasis &basis, const Eigen::MatrixXd &answers);

/// Uses the number of rigid-body modes of the full frame: with a single interface all of C*_11 is rounding, which is
/// removed along these modes; their frequencies are zero.
void name_free_motions(ReducedFrame &reduced, const fem::FrameMatrices &frame, const FixedInterfaceFrame &held,
                       const std::vector<int> &q1);

} // namespace gestell::coupling
