#pragma once

#include "coupling/frame/reduced_frame.h"

namespace gestell::coupling
{

/**
 * A small frame given by matrices in the form of a machine: all physical DOFs (not modal), those of interfaces first,
 * the others in their order.  A modal damping ratio zeta becomes
 *
 *     B + M Phi diag(2 zeta omega) Phi^T M,     C phi = omega^2 M phi,   phi^T M phi = 1.
 *
 * Matrices of a reduced frame, whose other coordinates are modes (M_LL = E, C_LL diagonal, C_LN = 0), are recognised:
 * `modal`, so that steps are condensed to the interface.
 *
 * @param frame  symmetric [n x n]; M may be semidefinite if C constrains the massless coordinates
 * @throws std::invalid_argument if C has a negative eigenvalue, or a motion has neither stiffness nor mass
 */
ReducedFrame dense_frame(const fem::FrameMatrices &frame);

/// R [n x 3] with M R = translations_load: input with which dense_frame() reproduces this load.  M may be singular.
Eigen::MatrixXd unit_translations(const ReducedFrame &frame);

} // namespace gestell::coupling
