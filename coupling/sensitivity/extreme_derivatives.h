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
 * An extreme has a derivative at a turning point of its signal, y' = 0, or at an event.  At an event the signal has
 * several values; the derivative is that of the value closest to the extreme.  The following have no derivative, with
 * the reason in the note: extremes that are zero within rounding; extremes at a corner or a jump without event, and all
 * others with nonzero y'; instants of a flat peak, with y'' not accurate to 1e-4, with the turning point more than a
 * step away, with a change lost in rounding, or with a shift longer than the run for 1 % of a parameter.
 *
 * Source: docs/theory/sensitivities.md (9) to (11).
 */
class ExtremeDerivatives
{
public:
  /// @param begin  [s] of the run
  /// @param near   [s] instants closer than this coincide
  ExtremeDerivatives(const RunResult &run, const std::vector<ParameterTwins> &twins, double begin, double near,
                     double length);

  /// Instants of extremes within a piece of the motion.
  std::set<double> instants(double begin, double end) const;
  bool             any_at(double t) const;
  /// Signals that have an extreme at t, and their largest |y|.
  std::map<std::size_t, double> turning_at(double t) const;

  /// At an event that shifts by dt: before it, between two coinciding events, after it.
  void at_event(double t, const Told &reported, const Eigen::VectorXd &rates, const Eigen::RowVectorXd &dt);
  /// At a turning point of a signal.
  /// @param step  [s] of the variational equations
  void at_turn(double t, std::size_t signal, const Turn &turn, double step);
  /// Extremes at the start t of their interval, which shifts by `dt`.
  void at_window(double t, const Told &reported, const Eigen::VectorXd &rates, const Eigen::RowVectorXd &dt);
  /// At the end of the run, which shifts by `end`.
  void at_end(double t, const Told &reported, const Eigen::VectorXd &rates, const Eigen::RowVectorXd &end);

  /// .min, .t_min, .max, .t_max, .final of every signal
  std::vector<OutputDerivatives> take() { return std::move(outputs_); }

private:
  struct Extreme
  {
    std::size_t signal;
    bool        largest;
    double      t, value;
    double      off; ///< error of the value that has the derivative
  };

  OutputDerivatives &output(const Extreme &extreme, bool instant);
  void               set(const Extreme &extreme, const Eigen::VectorXd &of_value, const Eigen::VectorXd &of_instant);
  void               leave_out(OutputDerivatives &output, const std::string &reason);
  bool               is_rounding(const Extreme &extreme) const;
  void               take(Extreme &extreme, const Turn &turn, double step);
  std::string        no_turn(const Extreme &extreme, const Turn &turn, double step) const;

  const std::vector<ParameterTwins> &twins_;
  double                             begin_, near_, length_;
  std::vector<Extreme>               extremes_;
  std::vector<double>                sizes_; ///< largest |y| of each signal
  std::vector<OutputDerivatives>     outputs_;
};

} // namespace gestell::coupling
