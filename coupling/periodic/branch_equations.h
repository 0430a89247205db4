#pragma once

#include "coupling/periodic/periodic_solution.h"

#include <Eigen/Core>

namespace gestell::coupling
{

/**
 * F(z, lambda) = 0, equations for periodic motions in unknowns z and a parameter lambda, as a continuation sees them:
 * those of shooting, collocation or harmonic balance.  Unknowns of neighbouring lambda are comparable.
 */
class BranchEquations
{
public:
  virtual ~BranchEquations() = default;

  /// z of a solution at lambda.
  virtual Eigen::VectorXd unknowns(const PeriodicSolution &solution, double lambda) = 0;
  /// F, and dF/dz where it is asked for.  @throws ConvergenceFailure
  virtual void evaluate(const Eigen::VectorXd &z, double lambda, bool jacobian) = 0;

  virtual const Eigen::VectorXd &residual() const = 0;
  virtual const Eigen::MatrixXd &jacobian() const = 0;
  virtual double                 closing() const  = 0; ///< size of F, relative
  /// Of the last evaluation; with multipliers where it had a jacobian.
  virtual PeriodicSolution solution() = 0;
  /// Moves what the equations take from the motion of the last evaluation, as mesh points at its events; z becomes its
  /// unknowns, as many as before.  False: all is where it should be.
  virtual bool follow_motion(Eigen::VectorXd &) { return false; }
  /// Takes unknowns that fit the motion of the last evaluation better, as those of a mesh that is divided where it
  /// errs: columns of Z [m x 2], z and a tangent, become those of the new ones.  False: it needs none.
  virtual bool refit(const PeriodicSolution &, Eigen::MatrixXd &) { return false; }
};

} // namespace gestell::coupling
