#pragma once

#include "coupling/sensitivity/output_derivatives.h"
#include "coupling/sensitivity/signal_derivatives.h"
#include "coupling/simulation/run_result.h"

#include <map>
#include <set>
#include <vector>

namespace gestell::coupling
{

/**
 * Derivatives of the largest and smallest values of signals, of their instants and of the values at the end of a run.
 *
 * An extreme has a derivative at a turning point of its signal, y' = 0, or at an event.  Of the values that a signal
 * has about an event it is the derivative of the one nearest to the extreme.  No derivative, with the reason in the
 * note, have: extremes that are zero within rounding; those at a corner or a jump without event, and all others with
 * nonzero y'; instants of a flat peak, with y'' not accurate to 1e-4, with the turning point more than a step away,
 * with a change lost in rounding, or shifted by more than the run by 1 % of a parameter.
 *
 * Source: docs/sensitivities.md (9) to (11).
 */
class ExtremeDerivatives
{
public:
  /// @param near  [s] apart, instants are one
  ExtremeDerivatives(const RunResult &run, const std::vector<ParameterTwins> &twins, double near, double length);

  /// Instants of extremes inside a piece of the motion.
  std::set<double> instants(double begin, double end) const;
  bool             any_at(double t) const;
  /// Signals that have an extreme there, and their largest |y|.
  std::map<std::size_t, double> turning_at(double t) const;

  /// Around an event that shifts by dt: before it, between two events of one instant, after it.
  void at_event(double t, const Told &reported, const Eigen::VectorXd &rates, const Eigen::RowVectorXd &dt);
  /// Where a signal turns.
  /// @param step  [s] of the variational equations
  void at_turn(double t, std::size_t signal, const Turn &turn, double step);
  /// Extremes at t, where they begin to count, which moves by `dt`.
  void at_window(double t, const Told &reported, const Eigen::VectorXd &rates, const Eigen::RowVectorXd &dt);
  /// The end of the run, which moves by `end`.
  void at_end(double t, const Told &reported, const Eigen::VectorXd &rates, const Eigen::RowVectorXd &end);

  /// .min, .t_min, .max, .t_max, .final of every signal
  std::vector<OutputDerivatives> take() { return std::move(outputs_); }

private:
  struct Extreme
  {
    std::size_t signal;
    bool        largest;
    double      t, value;
    double      off; ///< of the value that it has a derivative of
  };

  OutputDerivatives &output(const Extreme &extreme, bool instant);
  void               set(const Extreme &extreme, const Eigen::VectorXd &of_value, const Eigen::VectorXd &of_instant);
  void               leave_out(OutputDerivatives &output, const std::string &reason);
  bool               is_rounding(const Extreme &extreme) const;
  void               take(Extreme &extreme, const Turn &turn, double step);
  std::string        no_turn(const Extreme &extreme, const Turn &turn, double step) const;

  const std::vector<ParameterTwins> &twins_;
  double                             near_, length_;
  std::vector<Extreme>               extremes_;
  std::vector<double>                sizes_; ///< largest |y| of each signal
  std::vector<OutputDerivatives>     outputs_;
};

} // namespace gestell::coupling
