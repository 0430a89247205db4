#pragma once

#include "coupling/sensitivity/variational_equation.h"

#include <vector>

namespace gestell::coupling
{

/// Signals at a motion [n_y], and their derivatives by the parameters at a fixed time [n_y x K].
struct Told
{
  Eigen::VectorXd y;
  Eigen::MatrixXd dy;
};

/// Continuation of a signal after an instant.
enum class Kink
{
  none,
  corner, ///< its rate jumps
  jump    ///< the signal jumps
};

/// Time derivatives of a signal at or near a turning point.
struct Turn
{
  double          rate = 0., second = 0., off = 0.; ///< y', y'', error of y''
  Eigen::VectorXd dy, d_rate;                       ///< dy/dx, dy'/dx [K]
  Kink            kink   = Kink::none;
  double          before = 0., after = 0.; ///< y' of either side
  Eigen::VectorXd d_off{};                 ///< error of d_rate [K]; empty: none

  /// y'' is known to a ten thousandth: changes of instants are reported to this accuracy.
  bool known() const;
};

/// Taylor series of the motion about an instant: q'' of all coordinates (including massless ones, whose rate follows
/// from a law), and its rate.
struct Course
{
  Eigen::VectorXd second, third; // [n]
};

/// A motion, or its derivative by a parameter, and the rates of all quantities that signals read.
struct Moving
{
  MotionState at, rate;
};

/**
 * Signals of a run along a motion, and their derivatives. Derivatives by parameters at a fixed time follow from the two
 * machines of each parameter, at the motion changed by its derivative times the step. Time derivatives are quotients of
 * order 4 over a short interval of the smooth motion about an instant, on the branches that are active there.
 *
 * A shorter increment has less truncation error and more rounding. turn() tries increments of 1/3 to 1/50000 of a step
 * and uses the first of two neighbours with the best agreement of y''; their difference is the error. At a corner y''
 * grows as the increment shrinks, and neighbours never agree.
 *
 * A signal that is slow relative to the steps changes by less than its rounding over such increments.  Its rate is then
 * computed along the rates of the motion, y'(t) = (y(z + sigma z') - y(z - sigma z'))/2 sigma, where z is all its input
 * and sigma may be as long as the signal's own law is smooth, up to 5000 steps; y'' and dy'/dx are quotients of these
 * rates.  Again the first of the two neighbours with the best agreement is used, for y'' over two intervals.
 */
class SignalDerivatives
{
public:
  SignalDerivatives(Machine &machine, const std::vector<Signal> &signals, const std::vector<ParameterTwins> &twins,
                    VariationalEquation &equation);

  Eigen::VectorXd values(const MotionState &state) const;
  Told            tell(const MotionState &state, const MotionColumns &columns) const;
  /// The measures and forces at a motion changed by `by` times its derivative by parameter k.
  LocalState local_at(const MotionState &state, const MotionColumns &columns, int k, double by) const;

  /// @param way  [s] short relative to the motion
  Course course(const MotionState &state, double way);
  /// The motion at another instant.
  MotionState moved(const MotionState &state, const Course &course, double by);
  /// Computes the rates of measures, forces and multipliers, and of the signals.
  /// @param way  [s] short relative to the motion
  void find_rates(const MotionState &state, double way, LocalState &rates, Eigen::VectorXd &of_signals);
  /// Derivatives of a signal at its turning point near a motion, found by Newton's method.
  /// @param step  [s] of the variational equations
  /// @param size  largest value of the signal
  Turn turn(std::size_t signal, MotionState at, MotionColumns columns, double step, double size);

private:
  double find_turn(std::size_t signal, const MotionState &at, double step, double size, Turn &found);
  bool   find_slow_turn(std::size_t signal, const MotionState &at, double way, Turn &found);
  void   find_d_rates(std::size_t signal, const MotionState &at, const MotionColumns &columns, double way, Turn &found);
  Moving moving(const MotionState &at, double way);
  std::vector<Moving> moving(const MotionState &at, const MotionColumns &columns, double way);
  MotionColumns       moved(const MotionState &at, const MotionColumns &columns, double by);

  Machine                           &machine_;
  const std::vector<Signal>         &signals_;
  const std::vector<ParameterTwins> &twins_;
  VariationalEquation               &equation_;
};

} // namespace gestell::coupling
