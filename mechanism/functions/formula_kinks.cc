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

constexpr double out_of_play = std::numeric_limits<double>::quiet_NaN(); ///< argument of a kink that was not passed

bool jumps(const Formula &formula, int i)
{
  const std::string &function = formula.kinks()[i];
  return function == "sign" || function == "step" || function == "if";
}

/// Arguments of the kinks on the way through the formula and their rates.
struct Arguments
{
  Arguments(const Formula &formula, const double *x, const double *rates, const double *sides)
  {
    std::array<Dual, Formula::max_variables> moving;
    for (int i = 0; i < formula.n_variables(); ++i)
      moving[i] = Dual(x[i], Dual::DerType(rates[i]));
    std::fill_n(arguments, formula.n_kinks(), Dual(out_of_play));
    formula.kink_arguments(moving.data(), sides, arguments);
  }
  double value(int i) const { return arguments[i].value(); }
  double rate(int i) const { return arguments[i].derivatives()[0]; }
  bool   rests(int i) const { return value(i) == 0. && rate(i) == 0.; }

private:
  Dual arguments[Formula::max_kinks];
};

/// Sets the sides of all kinks on the way through the formula that are not settled, in its order: the argument of a
/// kink may depend on the kinks before it.
void settle(const Formula &formula, const double *x, const double *rates, Kinks settled, double *sides)
{
  for (bool changed = formula.n_kinks() > 0; changed;)
  {
    const Arguments arguments(formula, x, rates, sides);
    changed = false;
    for (int i = 0; i < formula.n_kinks() && !changed; ++i)
    {
      const double argument = arguments.value(i), rate = arguments.rate(i);
      if (settled[i] || std::isnan(argument))
        continue;
      const double goes = argument != 0. ? argument : rate; // where it goes, if at zero
      const double side = goes > 0. ? 1. : goes < 0. ? -1. : jumps(formula, i) ? 0. : 1.;
      changed           = side != sides[i];
      sides[i]          = side;
      settled.set(i);
    }
  }
}

Kinks in_play(const Formula &formula, const double *x, const double *sides)
{
  double arguments[Formula::max_kinks];
  std::fill_n(arguments, formula.n_kinks(), out_of_play);
  formula.kink_arguments(x, sides, arguments);
  Kinks kinks;
  for (int i = 0; i < formula.n_kinks(); ++i)
    kinks[i] = !std::isnan(arguments[i]);
  return kinks;
}

} // namespace

void FormulaKinks::start(const double *x, const double *rates, double *sides) const
{
  std::fill_n(sides, size(), 1.);
  settle(formula_, x, rates, Kinks(), sides);
}

std::vector<Guard> FormulaKinks::guards() const
{
  std::vector<Guard> guards;
  for (int i = 0; i < size(); ++i)
  {
    const std::string name = formula_.kinks()[i] + "_" + std::to_string(i + 1);
    guards.push_back({name + "_rises", Crossing::rising});
    guards.push_back({name + "_falls", Crossing::falling});
  }
  return guards;
}

void FormulaKinks::guard_values(const double *x, const double *sides, double *g) const
{
  double arguments[Formula::max_kinks];
  std::copy_n(sides, size(), arguments); // the side itself: kinks out of play are open
  formula_.kink_arguments(x, sides, arguments);
  for (int i = 0; i < size(); ++i)
  {
    g[2 * i]     = sides[i] > 0. ? -1. : arguments[i];
    g[2 * i + 1] = sides[i] < 0. ? 1. : arguments[i];
  }
}

void FormulaKinks::transition(int guard, const double *x, const double *rates, double *sides) const
{
  const int i       = guard / 2;
  Kinks     settled = in_play(formula_, x, sides);
  settled.set(i);
  sides[i] = guard % 2 == 0 ? 1. : -1.;
  settle(formula_, x, rates, settled, sides);
}

bool FormulaKinks::is_at_zero(const double *x, const double *rates, const double *sides) const
{
  const Arguments arguments(formula_, x, rates, sides);
  for (int i = 0; i < size(); ++i)
    if (jumps(formula_, i) && arguments.rests(i))
      return true;
  return false;
}

void FormulaKinks::rest(const double *x, const double *rates, double *sides) const
{
  const Arguments arguments(formula_, x, rates, sides);
  const Kinks     settled = in_play(formula_, x, sides);
  for (int i = 0; i < size(); ++i)
    if (jumps(formula_, i) && arguments.rests(i))
      sides[i] = 0.;
  settle(formula_, x, rates, settled, sides);
}

} // namespace gestell::mechanism
