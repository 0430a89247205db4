#pragma once

#include "coupling/reduction/shapes/fixed_interface_frame.h"
#include "coupling/reduction/shapes/reduction_basis.h"

namespace gestell::coupling
{

/**
 * Appends shapes of the inside as modes: their part that the basis does not have, made orthonormal in M and orthogonal
 * in C among themselves, so that M*_22 = E and C*_22 = diag(omega^2) stay true.
 *
 * Psi^T C w = 0 holds for any w that is zero on q1; modes kept before must be modes of the held frame or none.  What
 * remains of a shape below 1e-6 of it is rounding, and left out.
 *
 * @param basis  constraint modes, and modes of the held frame or none.
 * @param W      [n x k] shapes, zero on q1.
 * @return       number of modes appended, at most k.
 */
int append_attachment_modes(ReductionBasis &basis, const fem::FrameMatrices &frame, Eigen::MatrixXd W);

/**
 * Inertia relief: the static deflections of the inside under the inertia of rigid motions,
 *
 *     w_i = (0; C22^-1 (M R)_2 e_i),     R = rigid motions (6) or translations (3) of the frame.
 *
 * With them statics of a frame that floats and accelerates as a whole are exact (and those of any frame under weight),
 * whatever the number of modes: loads f on q1 in balance with the inertia of a rigid motion R alpha deflect the inside
 * by Psi q1 - C22^-1 (M R)_2 alpha.
 *
 * @return shapes [n x 6 or 3 or 0], zero on q1.
 */
Eigen::MatrixXd inertia_relief_shapes(const FixedInterfaceFrame &held, const fem::FrameMatrices &frame,
                                      const std::vector<int> &q1);

} // namespace gestell::coupling
