#include "mechanism/functions/formula_kinks.h"

#include <unsupported/Eigen/AutoDiff>

#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>
#include <limits>

namespace gestell::mechanism
{
namespace
{

using Kinks = std::bitset<Formula::max_kinks>;
using Dual  = Eigen::AutoDiffScalar<Eigen::Matrix<double, 1, 1>>;

constexpr double at_rest = std::numeric_limits<double>::quiet_NaN(); ///< argument of a kink that was not passed

/// Sets the sides of all kinks on the way through the formula that are not settled, in its order: the argument of a
/// kink may depend on the kinks before it.
void settle(const Formula &formula, const double *x, const double *rates, Kinks settled, double *sides)
{
  const int                                n = formula.n_kinks(), n_x = formula.n_variables();
  std::array<Dual, Formula::max_variables> moving;
  for (int i = 0; i < n_x; ++i)
    moving[i] = Dual(x[i], Dual::DerType(rates[i]));
  for (bool changed = n > 0; changed;)
  {
    Dual arguments[Formula::max_kinks];
    std::fill_n(arguments, n, Dual(at_rest));
    formula.kink_arguments(moving.data(), sides, arguments);
    changed = false;
    for (int i = 0; i < n && !changed; ++i)
    {
      const double argument = arguments[i].value(), rate = arguments[i].derivatives()[0];
      if (settled[i] || std::isnan(argument))
        continue;
      const double side = argument > 0. || (argument == 0. && rate >= 0.) ? 1. : -1.; // at zero: where it moves
      changed           = side != sides[i];
      sides[i]          = side;
      settled.set(i);
    }
  }
}

} // namespace

void FormulaKinks::start(const double *x, const double *rates, double *sides) const
{
  std::fill_n(sides, size(), 1.);
  settle(formula_, x, rates, Kinks(), sides);
}

std::vector<Guard> FormulaKinks::guards(const double *sides) const
{
  std::vector<Guard> guards;
  for (int i = 0; i < size(); ++i)
  {
    const bool        above = sides[i] > 0.;
    const std::string name  = formula_.kinks()[i] + "_" + std::to_string(i + 1);
    guards.push_back({name + (above ? "_falls" : "_rises"), above ? Crossing::falling : Crossing::rising});
  }
  return guards;
}

void FormulaKinks::guard_values(const double *x, const double *sides, double *g) const
{
  std::copy_n(sides, size(), g); // the guard is the side itself: kinks at rest are open
  formula_.kink_arguments(x, sides, g);
}

void FormulaKinks::transition(int i, const double *x, const double *rates, double *sides) const
{
  double arguments[Formula::max_kinks];
  std::fill_n(arguments, size(), at_rest);
  formula_.kink_arguments(x, sides, arguments);
  Kinks in_play;
  for (int k = 0; k < size(); ++k)
    in_play[k] = !std::isnan(arguments[k]);
  in_play.set(i);
  sides[i] = -sides[i];
  settle(formula_, x, rates, in_play, sides);
}

} // namespace gestell::mechanism
