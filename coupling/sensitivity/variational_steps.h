#pragma once

#include "coupling/sensitivity/variational_equation.h"
#include "coupling/simulation/trajectory.h"

#include <array>
#include <atomic>
#include <limits>

namespace gestell::coupling
{

/// Interpolation of a motion between its nodes: by the quintic through q, q', q'' of the two adjacent nodes, or the
/// cubic through q, q' if nodes are close.
class PieceReader
{
public:
  explicit PieceReader(VariationalEquation &equation) : equation_(equation) {}

  void begin(const SmoothPiece &piece);
  /// q, q' at state.t.
  /// @param close  [s] nodes within this distance are close
  void read(double close, MotionState &state);
  /// [s] distance of the nodes around the last instant read
  double spacing() const;

private:
  const Eigen::VectorXd &acceleration(std::size_t node);

  VariationalEquation                                   &equation_;
  const SmoothPiece                                     *piece_ = nullptr;
  std::size_t                                            here_  = 0;
  std::array<std::pair<std::size_t, Eigen::VectorXd>, 2> known_; ///< accelerations of nodes
  MotionState                                            node_;
};

/// Accuracy of the derivatives of a motion, relative to the largest of them.
struct VariationalAccuracy
{
  static constexpr double believed = 0.02; ///< errors up to this are not reported

  Eigen::RowVectorXd off; ///< of each parameter: largest error of the steps so far
  double             after = std::numeric_limits<double>::infinity(); ///< [s] after which one of them is not reliable
};

/**
 * Integrates s and s' along a smooth piece of a motion, by the singly diagonally implicit Runge-Kutta method of five
 * stages and order 4, stiffly accurate and L-stable, whose stages are steps of A = M + c B + c^2 C with c = H/4; the
 * step H, a power of two of the largest, is controlled by the embedded method of order 3.  Steps of the run are divided
 * down to a sixteenth.  The remaining error e is propagated like a derivative, E'' = ... without parameter terms, by
 * the implicit midpoint rule, and is part of the accuracy: truncation errors accumulate from period to period of an
 * oscillation because they have its phase, in contrast to rounding errors.  Events do not change E; after an element
 * starts to stick, its size is kept.
 *
 * The effect of a parameter on the motion is often mainly a shift in time, s = tau q' plus a remainder.  The errors of
 * the run are shifted too: they are in q' of the motion, but in no solution of the equations along it.  In peaks, where
 * all terms with tau must cancel, these errors would remain multiplied by tau.  After separate_shifts() each step
 * integrates only the remainder, with
 *
 *     tau = (s . q' + s' . q'')/(q' . q' + q'' . q'')
 *
 * scaled by the whole motion, and adds tau q' and tau q'' of the motion after the step.
 *
 * The accuracy also includes the error that the method of the run, with its step, would make in these derivatives (y''
 * and y''' by differences of the stages): the motion of the run has the same error.
 *
 * Source: Hairer, Wanner, Solving Ordinary Differential Equations II, 2nd ed., table IV.6.5;
 * docs/theory/sensitivities.md (6), (6a).
 */
class VariationalSteps
{
public:
  /// @param first      [s] the first step to be tried
  /// @param tolerance  of a step, relative to the largest derivatives so far or those expected
  /// @param run_order  of the run's method with fixed steps, if 1 or 2, to include its errors; 0: not included
  /// @param run_step   [s] of that method
  VariationalSteps(VariationalEquation &equation, double first, double tolerance, int run_order = 0,
                   double run_step = 0.);

  /// Sets lower bounds for the scales of the derivatives.  @param s,  s_rate  [n x K]
  void expect(const Eigen::MatrixXd &s, const Eigen::MatrixXd &s_rate);

  /// Makes further steps integrate s - tau q'; the error of the motion must be smaller than the tolerance.
  /// @param way,     speed  [n] ranges of the coordinates and their speeds in the run
  /// @param longest  [s per unit] largest shift for each parameter; beyond it the whole s is integrated
  void separate_shifts(const Eigen::VectorXd &way, const Eigen::VectorXd &speed, const Eigen::RowVectorXd &longest);

  /// Starts a piece.  @param s,  s_rate  [n x K]
  void begin(const SmoothPiece &piece, const Eigen::VectorXd &lambda, const Eigen::MatrixXd &s,
             const Eigen::MatrixXd &s_rate);
  /// @return whether t was reached: `stop` ends it before; null: no interruption
  bool advance_to(double t, const std::atomic<bool> *stop = nullptr);

  const MotionState   &state() const { return state_; }
  const Linearised    &linearised() const { return at_; }
  const MotionColumns &columns() const { return columns_; }
  double               step() const { return step_; } ///< [s] short compared with all motions
  long                 steps() const { return n_steps_; }

  const VariationalAccuracy &accuracy() const { return accuracy_; }

private:
  static constexpr int n_stages = 5;

  bool               try_step(double to);
  void               look_along(const SmoothPiece &piece);
  double             error(double length);
  Eigen::RowVectorXd relative_sizes(const Eigen::MatrixXd &e_q, const Eigen::MatrixXd &e_v) const;
  void               note_accuracy(double error, double length);
  void               settle_errors();
  void               split();
  void               join();
  void               shift_loads(double sign, Linearised &at) const;

  VariationalEquation                  &equation_;
  PieceReader                           reader_;
  double                                step_, tolerance_;
  int                                   run_order_;
  double                                run_step_;
  long                                  n_steps_ = 0;
  MotionState                           state_, stage_state_;
  Linearised                            at_, stage_at_;
  MotionColumns                         columns_, stage_;
  Eigen::VectorXd                       per_way_, per_speed_; ///< of moving coordinates; empty: s is not separated
  Eigen::RowVectorXd                    longest_;
  Eigen::RowVectorXd                    shift_;            ///< [s per unit] tau
  Eigen::MatrixXd                       rest_q_, rest_v_;  ///< s - tau q', s' - tau q''
  std::array<Eigen::MatrixXd, n_stages> v_, a_;            ///< s', s'' of the stages
  Eigen::MatrixXd                       size_q_, size_v_;  ///< largest |s|, |s'| so far
  Eigen::MatrixXd                       e_q_, e_v_;        ///< errors of a step
  MotionColumns                         left_, left_next_; ///< propagated errors of steps beyond the tolerance
  bool                                  leaves_ = false;   ///< there are such errors
  Eigen::RowVectorXd                    settled_;          ///< sizes of those before an element stuck
  Eigen::RowVectorXd                    of_run_;           ///< sum of the errors of the run's steps
  VariationalAccuracy                   accuracy_;
  Eigen::VectorXd                       root_mass_;
};

} // namespace gestell::coupling
