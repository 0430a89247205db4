#pragma once

#include "coupling/sensitivity/variational_equation.h"
#include "coupling/simulation/trajectory.h"

#include <array>
#include <atomic>
#include <limits>

namespace gestell::coupling
{

/// Interpolation of a motion between its nodes: by the quintic through q, q', q'' of the two next to it, or the
/// cubic through q, q' where nodes are close.
class PieceReader
{
public:
  explicit PieceReader(VariationalEquation &equation) : equation_(equation) {}

  void begin(const SmoothPiece &piece);
  /// q, q' at state.t.
  /// @param close  [s] nodes within this distance are close
  void read(double close, MotionState &state);
  /// [s] of the nodes about where it was read last
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
  static constexpr double believed = 0.02; ///< errors up to it are not reported

  Eigen::RowVectorXd off; ///< of each parameter: largest error of the steps so far
  double             after = std::numeric_limits<double>::infinity(); ///< [s] after which one of them is not reliable
};

/**
 * Integrates s and s' along a smooth piece of a motion, by the singly diagonally implicit Runge-Kutta method of five
 * stages and order 4, stiffly accurate and L-stable, whose stages are steps of A = M + c B + c^2 C with c = H/4; the
 * step H, from a ladder of powers of two, is controlled by the embedded method of order 3.  Steps of the run are
 * divided down to a sixteenth.  What that leaves, e, goes on as derivatives do, E'' = ... without what parameters
 * change, by the implicit midpoint rule, and counts to the accuracy: errors of truncation add up from period to period
 * of an oscillation, whose phase they have, while those of rounding have none.  Events do not change E; where something
 * sticks from then on its size stays.
 *
 * What a parameter makes of the motion is often a shift in time, s = tau q' and a rest.  The errors of the run are
 * moved with it, and are in q' of the motion, but in no solution of the equations along it; peaks, of which all that
 * has tau must cancel, would have tau times as much of them.  separate_shifts() has each step carry the rest, with
 *
 *     tau = (s . q' + s' . q'')/(q' . q' + q'' . q'')
 *
 * by shares of the whole motion, and add tau q' and tau q'' of the motion behind it.
 *
 * To the accuracy counts, too, what the method of the run, with its step, would make of these derivatives: y'' and y'''
 * by differences of the stages.  The run did make the motion by that method, so that the motion errs alike.
 *
 * Source: Hairer, Wanner, Solving Ordinary Differential Equations II, 2nd ed., table IV.6.5; docs/sensitivities.md (6),
 * (6a).
 */
class VariationalSteps
{
public:
  /// @param first      [s] the first step that is tried
  /// @param tolerance  of a step, of the largest derivatives so far or those expected
  /// @param run_order  of the run's method by fixed steps, if 1 or 2, whose errors are found; 0: they are not
  /// @param run_step   [s] likewise
  VariationalSteps(VariationalEquation &equation, double first, double tolerance, int run_order = 0,
                   double run_step = 0.);

  /// Derivatives count from these sizes on, however small they have been so far.  @param s, s_rate  [n x K]
  void expect(const Eigen::MatrixXd &s, const Eigen::MatrixXd &s_rate);

  /// From here on each step carries s - tau q', of a motion that errs less than the tolerance.
  /// @param way, speed  [n] of the coordinates, through the run
  /// @param longest     [s per unit] shift that counts for each parameter, beyond it s is carried whole
  void separate_shifts(const Eigen::VectorXd &way, const Eigen::VectorXd &speed, const Eigen::RowVectorXd &longest);

  /// At the beginning of a piece.  @param s, s_rate  [n x K]
  void begin(const SmoothPiece &piece, const Eigen::VectorXd &lambda, const Eigen::MatrixXd &s,
             const Eigen::MatrixXd &s_rate);
  /// @return whether it came there: `stop` ends it before; null: nothing does
  bool advance_to(double t, const std::atomic<bool> *stop = nullptr);

  const MotionState   &state() const { return state_; }
  const Linearised    &linearised() const { return at_; }
  const MotionColumns &columns() const { return columns_; }
  double               step() const { return step_; } ///< [s] short against what moves
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
  Eigen::VectorXd                       per_way_, per_speed_; ///< of coordinates that move; empty: s is carried whole
  Eigen::RowVectorXd                    longest_;
  Eigen::RowVectorXd                    shift_;            ///< [s per unit] tau
  Eigen::MatrixXd                       rest_q_, rest_v_;  ///< s - tau q', s' - tau q''
  std::array<Eigen::MatrixXd, n_stages> v_, a_;            ///< s', s'' of the stages
  Eigen::MatrixXd                       size_q_, size_v_;  ///< largest |s|, |s'| so far
  Eigen::MatrixXd                       e_q_, e_v_;        ///< errors of a step
  MotionColumns                         left_, left_next_; ///< what those beyond the tolerance have become
  bool                                  leaves_ = false;   ///< there are some
  Eigen::RowVectorXd                    settled_;          ///< sizes of those before something stuck
  Eigen::RowVectorXd                    of_run_;           ///< sum of what steps of the run would have left
  VariationalAccuracy                   accuracy_;
  Eigen::VectorXd                       root_mass_;
};

} // namespace gestell::coupling
