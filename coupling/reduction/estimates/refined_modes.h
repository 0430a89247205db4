#pragma once

#include "coupling/reduction/shapes/reduction_basis.h"
#include "coupling/reduction/shapes/residual_flexibility.h"

#include <Eigen/Core>

namespace gestell::coupling
{

/**
 * Modes of the supported frame with free interface, more accurate than those of the reduced model.
 *
 * All Ritz vectors T Phi* of the reduced model are improved together by one step of inverse iteration and a
 * Rayleigh-Ritz projection onto the result Y (one round of simultaneous iteration):
 *
 *     C Y = M T Phi*,     Y^T C Y g = omega^2 Y^T M Y g,     Phi = Y g.
 *
 * The inverse of the full C follows from the factor of C22 by block elimination with the constraint modes Psi,
 *
 *     C^-1 f = (0; C22^-1 f2) + Psi S^-1 Psi^T f,     S = C*_11 = C11 - C12 C22^-1 C21  [n1 x n1].
 *
 * For T Phi* = Psi a + V b this is Y = X a + V diag(1 / omega0^2) b + Psi c with X of ResidualFlexibility: only the 2
 * n1 + m columns of [T, X] are needed, without matrices or solutions of the size of the frame.
 *
 * If the frame floats, S has its rigid-body modes as null space (motions_without_stiffness()); they are exact in the
 * reduced model and omitted here.
 */
struct RefinedModes
{
  int             n_rigid = 0;
  Eigen::VectorXd omega;   // [p] elastic modes, refined, ascending [rad/s]
  Eigen::MatrixXd rigid{}; // [n1 x n_rigid] rigid-body modes on q1; none if only their number is known
};

RefinedModes refined_modes(const ReductionBasis &basis, const ReducedMatrices &star,
                           const ResidualFlexibility &response, const fem::FrameMatrices &frame);

/// The elastic modes of the reduced model itself, after n_rigid rigid-body modes: for models whose shapes are not
/// fixed-interface modes; as reference of its frequencies.
RefinedModes ritz_modes(const ReducedMatrices &star, int n_rigid);

/// Relative excess of the frequencies of the reduced model with the first m fixed-interface modes over the refined
/// ones.
struct FrequencyEstimate
{
  Eigen::VectorXd omega; // [n1 + m] of the reduced model, rigid-body modes first (0)
  Eigen::VectorXd error; // (omega - refined) / refined, >= 0; NaN if nothing is refined
};
FrequencyEstimate frequency_estimate(const ReducedMatrices &star, int n1, int m, const RefinedModes &refined);

} // namespace gestell::coupling
