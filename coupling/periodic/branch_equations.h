#pragma once

#include "coupling/periodic/periodic_solution.h"

#include <Eigen/Core>

namespace gestell::coupling
{

/**
 * F(z, lambda) = 0, equations for periodic motions in unknowns z and a parameter lambda, for a continuation: shooting,
 * collocation or harmonic balance. Unknowns of neighbouring lambda are comparable.
 */
class BranchEquations
{
public:
  virtual ~BranchEquations() = default;

  /// z of a solution at lambda.
  virtual Eigen::VectorXd unknowns(const PeriodicSolution &solution, double lambda) = 0;
  /// F, and dF/dz if requested.  @throws ConvergenceFailure
  virtual void evaluate(const Eigen::VectorXd &z, double lambda, bool jacobian) = 0;

  const Eigen::VectorXd &residual() const { return residual_; }
  const Eigen::MatrixXd &jacobian() const { return jacobian_; }
  double                 closing() const { return closing_; } ///< size of F, relative
  /// Part of the range over which dF/dlambda is taken: rounding and curvature leave 1e-6 and less of it.
  virtual double parameter_difference() const { return 1e-6; }
  /// Of the last evaluation; with multipliers where it had a jacobian.
  virtual PeriodicSolution solution() = 0;
  /// Updates data taken from the motion of the last evaluation, such as mesh points at its events; z becomes its
  /// unknowns, of the same number. False: no change.
  virtual bool follow_motion(Eigen::VectorXd &) { return false; }
  /// Changes to unknowns better suited to the motion of the last evaluation, such as those of a refined mesh: columns
  /// of Z [m x 2], z and a tangent, are converted. False: not needed.
  virtual bool refit(const PeriodicSolution &, Eigen::MatrixXd &) { return false; }

protected:
  Eigen::VectorXd residual_; ///< of the last evaluation, as the two below
  Eigen::MatrixXd jacobian_;
  double          closing_ = 0.;
};

} // namespace gestell::coupling
