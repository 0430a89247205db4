#pragma once

#include "coupling/periodic/period_flow.h"
#include "coupling/periodic/periodic_method.h"

#include <Eigen/LU>
#include <Eigen/QR>

#include <vector>

namespace gestell::coupling
{

/**
 * The cyclic system of linear equations
 *
 *     A_i x_i - x_(i+1) + b_i s = r_i,     i = 0 ... M - 1,     x_M = x_0,
 *
 * and (x_0)_phase = r_M if there are b_i.
 *
 * x_1, x_2 ... are eliminated by orthogonal transformations of two block rows at a time, so that the factors of A_i
 * stay apart: their product, which condensation to x_0 forms, loses all digits of x_0 where |A_(M-1) ... A_0| >
 * 1/epsilon.
 *
 * Source: Wright, SIAM J. Sci. Stat. Comput. 13(3), 1992, 742-764 (structured orthogonal factorisation).
 */
class CyclicSystem
{
public:
  /// @param A      A_i [N x N]
  /// @param b      columns b_i [N x M]; [N x 0]: there is no s
  /// @param phase  row of x_0 that is given where there is s
  CyclicSystem(const std::vector<Eigen::MatrixXd> &A, const Eigen::MatrixXd &b, Eigen::Index phase);

  /// (x_0, x_1 ... x_(M-1), s) for the right side (r_0 ... r_(M-1), r_M).
  Eigen::VectorXd solve(const Eigen::VectorXd &r) const;

private:
  /// R x_i + begin (x_0, s) + next x_(i+1) = right, R that of `rows`
  struct Elimination
  {
    Eigen::HouseholderQR<Eigen::MatrixXd> rows;
    Eigen::MatrixXd                       begin, next;
  };

  Eigen::Index                         N_;
  Eigen::Index                         extra_; ///< 1: there is s
  std::vector<Elimination>             eliminations_;
  Eigen::PartialPivLU<Eigen::MatrixXd> closing_; ///< of (x_0, s)
};

/**
 * The equations of multiple shooting: unknowns z are the states x_i = (Omega q, q') at M instants t_i
 * [2n M], and T behind them [s] where it is unknown; the equations are the zero gaps
 *
 *     r_i(z) = phi_i(x_i) - x_(i+1),   i = 0 ... M - 2,      r_(M-1)(z) = phi_(M-1)(x_(M-1)) - x_0 - turn,
 *
 * phi_i the motion from t_i to t_(i+1), and q_phase(t_0) - given where T is unknown.  Perturbations grow by the M-th
 * root of the largest multiplier in a segment, so that Newton's method solves orbits too unstable to integrate for a
 * period.
 *
 * Source: Morrison, Riley, Zancanaro, Comm. ACM 5(12), 1962, 613-614; Stoer and Bulirsch, section 7.3.5.
 */
class SegmentEquations
{
public:
  /// @param segments  M, >= 1.  @throws std::invalid_argument
  SegmentEquations(const PeriodicProblem &problem, const MethodOptions &integration, int segments);

  /// States of the motion that begins at the guess.  @throws ConvergenceFailure
  Eigen::VectorXd along_motion(const PeriodicGuess &guess);
  /// All states at the place of the guess, or on the straight way to its turn.
  Eigen::VectorXd at_one_place(const PeriodicGuess &guess) const;

  /// Integrates all segments with their tangents.
  /// @throws ConvergenceFailure, also if elements have hysteresis at the end of a segment
  void evaluate(const Eigen::VectorXd &z);

  /// Rejects segments with many more steps than in the last evaluation.
  void expect_no_more();

  int                    segments() const { return M_; }
  const Eigen::VectorXd &residual() const { return residual_; }     ///< r(z)
  CyclicSystem           matrix() const;                            ///< dr/dz, its rows those of residual()
  double                 closing() const { return closing_; }       ///< closing_error() of all gaps together
  double                 fastest() const { return whole_.fastest; } ///< [rad/s] or [m/s], see PeriodPassage

  /// The solution that the last evaluation is; multipliers from the product of all segments.
  PeriodicSolution solution() const;
  /// closing_error() of the period in one passage from z, which shows the growth of rounding errors.
  /// @throws ConvergenceFailure
  double closing_in_one(const Eigen::VectorXd &z);

private:
  double               period_of(const Eigen::VectorXd &z) const;
  double               share(int i) const; ///< of the period, at which segment i begins
  double               part(int i) const { return share(i + 1) - share(i); }
  const PeriodPassage &pass(const Eigen::VectorXd &z, int i, double period, bool tangents);
  void                 take(const PeriodPassage &part, int i);

  PeriodicProblem              problem_; ///< its most_steps those of a segment
  MethodOptions                integration_;
  int                          M_;
  double                       omega_; ///< Omega of the unknowns
  PeriodFlow                   flow_;
  PeriodPassage                whole_; ///< all segments together
  Eigen::VectorXd              residual_;
  std::vector<Eigen::MatrixXd> parts_;       ///< d phi_i/dx_i [2n x 2n]
  Eigen::MatrixXd              by_time_;     ///< d phi_i/dT
  std::vector<OrbitState>      states_;      ///< of the last evaluation
  long                         steps_   = 0; ///< that it took
  double                       closing_ = 0.;
  PeriodicWork                 work_;
};

/**
 * Newton's method on SegmentEquations from z, each step halved until the step that the same matrix gives behind it is
 * shorter (natural monotonicity: Deuflhard, Newton Methods for Nonlinear Problems, 2004, section 3.3).
 *
 * @throws NoPeriodicMotion if it stops with gaps above the tolerance; ConvergenceFailure
 */
PeriodicSolution shoot_in_segments(SegmentEquations &equations, const PeriodicProblem &problem, Eigen::VectorXd z,
                                   const PeriodicOptions &options);

/// The same for options.segments, or 8 and 32, from the motion that begins at the guess, and from states at its place.
/// @throws NoPeriodicMotion, with the residual of each
PeriodicSolution shoot_in_segments(const PeriodicProblem &problem, const PeriodicGuess &guess,
                                   const PeriodicOptions &options);

} // namespace gestell::coupling
