#pragma once

#include "mechanism/branches.h"
#include "mechanism/functions/cubic_spline.h"
#include "mechanism/functions/formula_kinks.h"

#include <memory>
#include <optional>

namespace gestell::mechanism
{

/**
 * A function f(x) of one variable with its first two derivatives: the position function of a cam or an indexing drive
 * (f the position of the follower, x the angle of the shaft), or a motion over time.
 *
 * Given by a formula, or by a table that a CubicSpline interpolates.  With a period P
 *
 *     f(x + P) = f(x) + rise,     given for begin <= x < begin + P.
 *
 * A table that is not periodic is extrapolated linearly beyond its ends.
 *
 * Smooth between kinks: those of the formula (FormulaKinks), or the ends of the table, "table_begins" and "table_ends".
 * A formula with kinks and a period has events between periods, "next_period", "previous_period".  The present piece is
 * history [n_history()] of the user of the function; without history x decides.
 *
 * Source: Dresig, Vul'fson, Dynamik der Mechanismen, position functions; docs/theory/position_functions.md (1).
 */
class PositionFunction
{
public:
  struct Period
  {
    double length = 0.; ///< P, > 0
    double begin  = 0.; ///< of the period for which the formula is given
    double rise   = 0.; ///< over one period
  };
  using Value = CubicSpline::Value; ///< f, f', f''

  /// @param formula  of variable(0)
  /// @throws std::invalid_argument if f is not continuous at the ends of its period; without kinks also f' and f''
  explicit PositionFunction(const Formula &formula, const std::optional<Period> &period = {});
  /// @throws std::invalid_argument as CubicSpline does
  explicit PositionFunction(const CubicSpline &spline) : formula_(0.), spline_(spline) {}

  Value at(double x, const double *history = nullptr) const;

  int  n_history() const { return spline_ ? table_ends() : formula_.n_kinks() + int(counts_periods()); }
  int  n_guards() const { return spline_ ? table_ends() : formula_.n_kinks() + 2 * int(counts_periods()); }
  void start(double x, double rate, double *history) const;
  std::vector<Guard> guards(const double *history) const;
  void               guard_values(double x, const double *history, double *g) const;
  void               transition(int i, double x, double rate, double *history) const;

private:
  int    table_ends() const { return spline_->is_periodic() ? 0 : 2; }
  bool   counts_periods() const { return period_ && formula_.n_kinks() > 0; }
  double periods(double x) const; ///< number of whole periods from the given one to x
  double periods(double x, const double *history) const;
  void   check_closure() const;

  Formula                    formula_;
  std::optional<Period>      period_;
  std::optional<CubicSpline> spline_;
};

} // namespace gestell::mechanism
