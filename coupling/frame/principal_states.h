#pragma once

#include <Eigen/Core>

namespace gestell::coupling
{

/**
 * States in principal components, z(t) = sum_r b_r c_r(t), in descending order of size in the norm
 * |c|^2 = sum_i |S_i z|^2 over the points of a frame.  Directions in which this norm is rounding come last, so that the
 * b_r are a basis of all states.
 */
struct PrincipalStates
{
  Eigen::MatrixXd basis;        ///< b_r [n x n]
  Eigen::MatrixXd components;   ///< c_r [samples x n]
  Eigen::Index    measured = 0; ///< number of the first ones; the norm of the others is rounding
};

/// @param states  [n x samples]
/// @param gram    [n x n] sum of S_i^T S_i
/// Source: docs/theory/stress.md (4).
PrincipalStates principal_states(const Eigen::MatrixXd &states, const Eigen::MatrixXd &gram);

} // namespace gestell::coupling
