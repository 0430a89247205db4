#pragma once

#include "coupling/integration/system/convergence_failure.h"

#include <Eigen/Core>

#include <functional>

namespace gestell::coupling
{

/// A step of Newton's method for r(z) = 0, and the rule by which it is shortened.
struct NewtonStep
{
  Eigen::VectorXd dz;                   ///< -J^-1 r, J that of z or of an earlier point; empty: the search ends
  double          length   = 0.;        ///< |r(z)|, in any norm
  double          decrease = 0.1;       ///< of the length by the whole step, by a share of it in proportion
  double          share    = 1.;        ///< of the step, which is tried first
  double          least    = 1. / 4096; ///< of this share: a direction that reduces the length does so earlier
};

struct NewtonResult
{
  bool   converged  = false; ///< set by step()
  bool   stalled    = false; ///< no share of the last step reduces the length
  int    iterations = 0;     ///< steps taken
  double residual   = 0.;    ///< relative, of the last point; set by step()
};

/**
 * Newton's method with damping: steps z + share dz, the share halved until
 *
 *     |r(z + share dz)| < (1 - decrease share) |r(z)|.
 *
 * The norm belongs to the step: scaled residuals, or the next step by the same matrix (natural monotonicity: Deuflhard,
 * Newton Methods for Nonlinear Problems, 2004, section 3.3).
 *
 * @param z       start, and the last point reached
 * @param most    iterations
 * @param step    the step from z; it may set the members of the result
 * @param length  |r| at a trial point, infinite or a ConvergenceFailure where it has none; after a stall it is called
 *                for z again
 */
inline NewtonResult solve_by_newton(Eigen::VectorXd &z, int most, const std::function<NewtonStep(NewtonResult &)> &step,
                                    const std::function<double(const Eigen::VectorXd &)> &length)
{
  NewtonResult result;
  while (!result.stalled && result.iterations < most)
  {
    const auto [dz, before, decrease, first, least] = step(result);
    if (dz.size() == 0)
      break;
    result.stalled = true;
    for (double share = first; result.stalled && share > least * first && dz.allFinite(); share *= 0.5)
      try
      {
        const Eigen::VectorXd next = z + share * dz;
        if (!(length(next) < (1. - decrease * share) * before))
          continue;
        z              = next;
        result.stalled = false;
        ++result.iterations;
      }
      catch (const ConvergenceFailure &)
      {
      }
    if (result.stalled)
      length(z);
  }
  return result;
}

} // namespace gestell::coupling
