#pragma once

#include "coupling/periodic/period_flow.h"
#include "coupling/periodic/periodic_method.h"

namespace gestell::coupling
{

/**
 * The equations of shooting for one problem, unknowns z = (Omega q, q') at t_0 [2n], and T behind them [s] where it is
 * unknown:
 *
 *     r(z) = (Omega (q(T) - q(0) - turn), q'(T) - q'(0)),     dr/dz = S (Phi - E) S^-1,  dr/dT = (Omega q'(T), q''(T)),
 *
 * Phi the monodromy matrix, S = diag(Omega, 1).  Where T is unknown a last row keeps the phase: q_phase(0) = given.
 */
class ShootingEquations
{
public:
  /// @param omega  Omega of the unknowns; 0: that of the problem's period
  ShootingEquations(const PeriodicProblem &problem, const MethodOptions &integration, double omega = 0.);

  PeriodFlow &flow() { return flow_; }

  Eigen::VectorXd unknowns(const Eigen::VectorXd &q, const Eigen::VectorXd &v, double period) const;
  /// Integrates one period from z.  @throws ConvergenceFailure
  const PeriodPassage &evaluate(const Eigen::VectorXd &z, bool jacobian);

  /// The same with tangents dq, dv [n x k] alone, whose images are the passage's `monodromy`.
  const PeriodPassage &evaluate_with(const Eigen::VectorXd &z, const Eigen::MatrixXd &dq, const Eigen::MatrixXd &dv);

  double omega() const { return omega_; }
  /// d(q, q')(T)/dT of the last evaluation [2n].
  Eigen::VectorXd        rate_at_end();
  const Eigen::VectorXd &residual() const { return residual_; } ///< r(z), the last of them zero for the phase
  const Eigen::MatrixXd &jacobian() const { return jacobian_; }
  double                 closing() const { return closing_; } ///< closing_error()
  long                   passages() const { return passages_; }
  const IntegrationWork &work() const { return work_; }

  /// The solution that the last evaluation is, with the multipliers of its monodromy matrix if it has one.
  PeriodicSolution solution(const std::string &method) const;

private:
  const PeriodPassage &pass(const Eigen::VectorXd &z, bool tangents);

  const PeriodicProblem &problem_;
  MethodOptions          integration_;
  PeriodFlow             flow_;
  double                 omega_; ///< Omega of the unknowns
  Eigen::VectorXd        residual_;
  Eigen::MatrixXd        jacobian_;
  double                 closing_  = 0.;
  long                   passages_ = 0;
  IntegrationWork        work_;
};

/// Rejects rest as a solution if the period is unknown and nothing rotates.
/// @throws NoPeriodicMotion if the solution moves less than 1e-6 of the guess
void refuse_rest(const PeriodicProblem &problem, const PeriodicGuess &guess, const PeriodicSolution &found);

/// The motion of a coordinate is undetermined for any initial guess.
struct UndeterminedMotion : NoPeriodicMotion
{
  using NoPeriodicMotion::NoPeriodicMotion;
};

/// Adds a note for users if the residual is above the tolerance.
void note_residual(PeriodicSolution &solution, double tolerance);

/// The motion of a passage with the residual `closing`, with the multipliers of its monodromy matrix if it has one.
PeriodicSolution solution_of(const PeriodicProblem &problem, const MethodOptions &integration,
                             const PeriodPassage &passage, double closing);

/**
 * Newton's method from z, each step halved until the residual decreases.
 *
 * @throws NoPeriodicMotion if it stops before closing() is below the tolerance, with the free coordinate if the matrix
 * is singular; ConvergenceFailure
 */
PeriodicSolution shoot(ShootingEquations &equations, const PeriodicProblem &problem, Eigen::VectorXd z,
                       const PeriodicOptions &options);

} // namespace gestell::coupling
