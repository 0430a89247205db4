#pragma once

#include "mechanism/branches.h"
#include "mechanism/functions/formula.h"

#include <string>
#include <vector>

namespace gestell::mechanism
{

/**
 * The kinks of a formula as guards of whatever follows it: an element, a joint, a prescribed motion.
 *
 * `sides` [n_kinks()] is history: the side of each kink, -1, 1, or 0 where its argument rests at zero, which matters to
 * sign, step and if: they have the value at zero until the argument leaves it, to either side.  The value of a guard is
 * the argument of its kink.  Events are called after the function, the place of the kink in the formula and where its
 * argument goes: "abs_1_rises", "if_2_falls".
 */
class FormulaKinks
{
public:
  explicit FormulaKinks(const Formula &formula) : formula_(formula) {}

  int size() const { return formula_.n_kinks(); }
  int n_guards() const { return 2 * size(); } ///< its argument rises, and falls; one of them is open unless it rests

  /// The sides of a motion that begins at x, with the rates x' [n_variables() each].
  void               start(const double *x, const double *rates, double *sides) const;
  std::vector<Guard> guards() const;
  void               guard_values(const double *x, const double *sides, double *g) const;
  /// The argument of a kink leaves a side or zero; kinks that it made inactive may become active.
  void transition(int guard, const double *x, const double *rates, double *sides) const;
  /// Whether the argument of an active sign, step or if rests at zero: it and its rate vanish.
  bool is_at_zero(const double *x, const double *rates, const double *sides) const;
  /// The side of each of these becomes 0.
  void rest(const double *x, const double *rates, double *sides) const;

private:
  const Formula &formula_;
};

} // namespace gestell::mechanism
