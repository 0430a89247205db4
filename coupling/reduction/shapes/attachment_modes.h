#pragma once

#include "coupling/reduction/shapes/fixed_interface_frame.h"
#include "coupling/reduction/shapes/reduction_basis.h"

namespace gestell::coupling
{

/**
 * Appends internal shapes as modes: their part outside of the basis, orthonormal in M and orthogonal in C, so that
 * M*_22 = E and C*_22 = diag(omega^2) remain valid.
 *
 * Psi^T C w = 0 holds for any w that is zero on q1; existing modes must be fixed-interface modes or none. A remainder
 * below 1e-6 of a shape is rounding and is omitted.
 *
 * @param basis  constraint modes, and fixed-interface modes or none.
 * @param W      [n x k] shapes, zero on q1.
 * @return       number of modes appended, at most k.
 */
int append_attachment_modes(ReductionBasis &basis, const FixedInterfaceFrame &held, Eigen::MatrixXd W);

/**
 * Inertia relief: the static internal deflections under the inertia of rigid-body modes,
 *
 *     w_i = (0; C22^-1 (M R)_2 e_i),     R = rigid motions (6) or translations (3) of the frame.
 *
 * With them the statics of an accelerated floating frame (and of any frame under weight) are exact for any number of
 * modes: loads f on q1 in balance with the inertia of a rigid-body motion R alpha cause the internal deflection Psi q1
 * - C22^-1 (M R)_2 alpha.
 *
 * @return shapes [n x 6 or 3 or 0], zero on q1.
 */
Eigen::MatrixXd inertia_relief_shapes(const FixedInterfaceFrame &held, const fem::FrameMatrices &frame,
                                      const std::vector<int> &q1);

} // namespace gestell::coupling
