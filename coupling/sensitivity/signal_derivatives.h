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

/// What becomes of signals in time.
struct SignalRates
{
  Eigen::VectorXd rate, second; ///< y', y'' [n_y]
  Eigen::MatrixXd d_rate;       ///< dy'/dx [n_y x K]
};

/**
 * Signals of a run along a motion, and their derivatives: by parameters at a fixed time, from the two machines of each
 * parameter at the motion moved by as much of its derivative; in time, by quotients over a little of the smooth motion
 * about an instant, of order 4, on the branches that hold there.
 */
class SignalDerivatives
{
public:
  SignalDerivatives(Machine &machine, const std::vector<Signal> &signals, const std::vector<ParameterTwins> &twins,
                    VariationalEquation &equation);

  Eigen::VectorXd values(const MotionState &state) const;
  Told            tell(const MotionState &state, const MotionColumns &columns) const;
  /// The measures and forces at a motion moved by `by` times its derivative by parameter k.
  LocalState local_at(const MotionState &state, const MotionColumns &columns, int k, double by) const;

  /// The motion at another instant by Taylor's series.
  MotionState moved(const MotionState &state, const Eigen::VectorXd &jerk, double by);
  /// Rates of measures, forces and multipliers, and of the signals.
  /// @param way  [s] short against what moves
  void        find_rates(const MotionState &state, double way, LocalState &rates, Eigen::VectorXd &of_signals);
  SignalRates rates(const MotionState &state, const MotionColumns &columns, double way);

private:
  Eigen::VectorXd jerk(const MotionState &state, double by);
  MotionColumns   moved(const MotionState &at, const MotionColumns &columns, double by);

  Machine                           &machine_;
  const std::vector<Signal>         &signals_;
  const std::vector<ParameterTwins> &twins_;
  VariationalEquation               &equation_;
};

} // namespace gestell::coupling
