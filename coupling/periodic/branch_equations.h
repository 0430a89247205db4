#pragma once

#include "coupling/periodic/harmonic_balance.h"
#include "coupling/periodic/shooting.h"

#include <functional>
#include <memory>

namespace gestell::coupling
{

/// A problem at one value of a parameter, with what it lives on.
struct FamilyMember
{
  PeriodicProblem       problem;
  std::shared_ptr<void> owner; ///< of the system
};

/// The problem at each value of a parameter.  @throws std::invalid_argument where there is none
using ProblemFamily = std::function<FamilyMember(double)>;

/**
 * F(z, lambda) = 0, equations for periodic motions in unknowns z and a parameter lambda, as a continuation sees them:
 * those of shooting or of harmonic balance.  Unknowns of neighbouring lambda are comparable.
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
  /// Of the last evaluation, which had a jacobian; with multipliers.
  virtual PeriodicSolution solution() = 0;
};

/// Shooting over `ratio` times the period of the family.
std::unique_ptr<BranchEquations> shooting_branch(const ProblemFamily &family, const PeriodicOptions &options,
                                                 double omega, int ratio = 1);
/// Harmonic balance with options.harmonics, which must be given.
std::unique_ptr<BranchEquations> balance_branch(const ProblemFamily &family, const PeriodicOptions &options);

} // namespace gestell::coupling
