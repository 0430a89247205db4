#pragma once

#include "apps/analysis/life/damage/cycles.h"
#include "coupling/frame/principal_states.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace gestell::apps
{

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
CoarseLoad coarse_load(const coupling::PrincipalStates &states, const LoadSequence &load, double tolerance,
                       const CoarseLoad *coarser = nullptr);

} // namespace gestell::apps
