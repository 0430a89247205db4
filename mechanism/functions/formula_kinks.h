#pragma once

#include "mechanism/branches.h"
#include "mechanism/functions/formula.h"

#include <string>
#include <vector>

namespace gestell::mechanism
{

/**
 * The kinks of a formula as guards of its user: an element, a joint, a prescribed motion.
 *
 * `sides` [n_kinks()] is history: the side of each kink, -1 or 1.  The value of a guard is the argument of its kink.
 * Event names contain the function, the position of the kink in the formula and the direction of its argument:
 * "abs_1_rises", "if_2_falls".
 */
class FormulaKinks
{
public:
  explicit FormulaKinks(const Formula &formula) : formula_(formula) {}

  int size() const { return formula_.n_kinks(); }

  /// The sides of a motion that starts at x, with the rates x' [n_variables() each].
  void               start(const double *x, const double *rates, double *sides) const;
  std::vector<Guard> guards(const double *sides) const;
  void               guard_values(const double *x, const double *sides, double *g) const;
  /// Kink i changes sides; kinks that it made inactive may become active.
  void transition(int i, const double *x, const double *rates, double *sides) const;

private:
  const Formula &formula_;
};

} // namespace gestell::mechanism
