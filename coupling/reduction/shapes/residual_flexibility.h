#pragma once

#include "coupling/reduction/shapes/fixed_interface_frame.h"
#include "coupling/reduction/shapes/reduction_basis.h"

#include <Eigen/Core>

namespace gestell::coupling
{

/**
 * Internal deflection with the interface fixed under loads independent of the retained modes: the inertia forces of the
 * constraint modes and given loads. For the former, X = C22^-1 (M Psi)_2 [n x n1], zero on q1, a few products are
 * sufficient: with V22 exact, C22^-1 (M T)_2 = [X, V22 diag(1 / omega0^2)] and V22^T M X = diag(1 / omega0^2) M*_21.
 * Thus a round of inverse iteration for all Ritz vectors of the reduced model needs only these n1 solutions.  A third
 * product, with X2 = C22^-1 (M X)_2, serves InterfaceReceptance.
 */
struct ResidualFlexibility
{
  Eigen::MatrixXd Psi_M_X; // Psi^T M X [n1 x n1]
  Eigen::MatrixXd X_M_X;   // X^T M X [n1 x n1]
  Eigen::MatrixXd X_M_X2;  // X^T M X2 [n1 x n1]
  Eigen::MatrixXd loads;   // C22^-1 f2 [n x k]
};

/// @param loads f [n x k]; its part on q1 is ignored.
ResidualFlexibility residual_flexibility(const FixedInterfaceFrame &held, const ReductionBasis &basis,
                                         const Eigen::MatrixXd &loads);

/// X itself: the shapes that complete a few modes (reduction.md (16d)).
Eigen::MatrixXd inertia_shapes(const FixedInterfaceFrame &held, const ReductionBasis &basis);

} // namespace gestell::coupling
