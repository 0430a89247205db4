#pragma once

#include "apps/analysis/life/damage/cycles.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace gestell::apps
{

/**
 * States of a load in principal components, z(t) = mean + sum_r b_r c_r(t), in descending order of size, in the norm
 * |c|^2 = sum_i |S_i (z - mean)|^2 over the points of a frame.
 */
struct PrincipalStates
{
  Eigen::MatrixXd basis;        ///< b_r [n x n]
  Eigen::VectorXd mean;         ///< [n]
  Eigen::MatrixXd components;   ///< c_r [samples x n]
  Eigen::Index    measured = 0; ///< number of the first ones; the norm of the others is rounding
};

/// @param states  [n x samples]
/// @param gram    [n x n] sum of S_i^T S_i
PrincipalStates principal_states(const Eigen::MatrixXd &states, const Eigen::MatrixXd &gram);

/// The largest components of a load at some of its samples, lines between them, and what is left out.
struct CoarseLoad
{
  std::vector<std::int64_t> samples;       ///< [chosen] the first and the last of each block, and others
  LoadSequence              load;          ///< its blocks in these
  Eigen::MatrixXd           components;    ///< [chosen x kept], the first ones
  Eigen::ArrayXd            largest;       ///< [n] max |c_r - line|; the line of a component that is left out is zero
  Eigen::ArrayXd            variation;     ///< [n] total variation of c_r - line in one repetition of the load
  Eigen::MatrixXd           slope;         ///< [n x chosen] max |step of c_r - line| until the next chosen sample
  double                    distance = 0.; ///< max |c - line| of the measured ones
};

/**
 * @param tolerance  of the distance, relative to max |c|
 * @param coarser    null, or a load some of whose lines are divided further
 */
CoarseLoad coarse_load(const PrincipalStates &states, const LoadSequence &load, double tolerance,
                       const CoarseLoad *coarser = nullptr);

} // namespace gestell::apps
