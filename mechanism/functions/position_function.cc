#include "mechanism/functions/position_function.h"

#include "mechanism/require.h"

#include <algorithm>
#include <cmath>

namespace gestell::mechanism
{
namespace
{

enum TableEnd
{
  begins,
  ends
};

} // namespace

PositionFunction::PositionFunction(const Formula &formula, const std::optional<Period> &period)
    : formula_(formula), period_(period)
{
  require(formula.n_variables() <= 1, "position function", "number of variables", formula.n_variables(), "1: x");
  if (!period)
    return;
  require(period->length > 0., "position function", "period", period->length, "positive");
  check_closure();
}

/// Both ends of the period, a little inside, so that kinks that lie just there are on the side of the period.
void PositionFunction::check_closure() const
{
  const double inside = 1e-12 * period_->length, first = period_->begin, last = first + period_->length;
  const auto   a = at(first + inside), b = at(last - inside);
  double       scale = std::abs(period_->rise);
  for (int i = 0; i <= 32; ++i) // scale of rounding: the ends may be flat and zero
  {
    const auto between = at(first + inside + i / 32. * (period_->length - 2. * inside));
    scale              = std::max({scale, std::abs(between.value), std::abs(between.first) * period_->length});
  }
  const std::string name = "position function", out = "; close it, or give another 'rise', 'period' or 'begin'";
  const auto        compare = [&](const std::string &what, double here, double there, double unit)
  {
    std::ostringstream needed;
    needed << there << ", equal to the beginning of the next period" << out;
    constexpr double joined = 1e-9; // gap at the ends of a period: rounding of constants such as pi
    require(std::abs(here - there) <= joined * scale / unit, name, what + " at the end of the period", here,
            needed.str());
  };
  const double P = period_->length;
  compare("value", b.value, a.value + period_->rise, 1.);
  if (formula_.n_kinks() > 0)
    return; // the passage is an event, as any kink
  compare("slope", b.first, a.first, P);
  compare("second derivative", b.second, a.second, 1e-3 * P * P);
}

double PositionFunction::periods(double x) const
{
  return period_ ? std::floor((x - period_->begin) / period_->length) : 0.;
}

double PositionFunction::periods(double x, const double *history) const
{
  return history && counts_periods() ? history[formula_.n_kinks()] : periods(x);
}

PositionFunction::Value PositionFunction::at(double x, const double *history) const
{
  if (spline_)
  {
    if (spline_->is_periodic())
      return spline_->at(x);
    const bool   before = history ? history[begins] < 0. : x < spline_->begin();
    const bool   after  = history ? history[ends] > 0. : x > spline_->end();
    const double end    = before ? spline_->begin() : spline_->end();
    if (!before && !after)
      return spline_->at(x);
    const Value there = spline_->at(end);
    return {there.value + there.first * (x - end), there.first, 0.};
  }
  const double n = periods(x, history), direction = 1.;
  const double inner = period_ ? x - n * period_->length : x;
  const auto   f     = formula_.along(&inner, &direction, history);
  return {f.value + (period_ ? n * period_->rise : 0.), f.first, f.second};
}

// --- kinks

void PositionFunction::start(double x, double rate, double *history) const
{
  if (spline_ && n_guards() > 0)
  {
    guard_values(x, history, history);
    for (int i = 0; i < 2; ++i)
      history[i] = history[i] > 0. || (history[i] == 0. && rate >= 0.) ? 1. : -1.;
  }
  if (spline_ || formula_.n_kinks() == 0)
    return;
  double n = periods(x);
  if (counts_periods())
  {
    if (rate < 0. && x == period_->begin + n * period_->length)
      n -= 1.; // the period that it enters
    history[formula_.n_kinks()] = n;
  }
  const double inner = period_ ? x - n * period_->length : x;
  FormulaKinks(formula_).start(&inner, &rate, history);
}

std::vector<Guard> PositionFunction::guards(const double *history) const
{
  if (!spline_)
  {
    auto guards = FormulaKinks(formula_).guards(history);
    if (counts_periods())
    {
      guards.push_back({"next_period", Crossing::rising});
      guards.push_back({"previous_period", Crossing::falling});
    }
    return guards;
  }
  if (n_guards() == 0)
    return {};
  const auto crossing = [&](int i) { return history[i] > 0. ? Crossing::falling : Crossing::rising; };
  return {{"table_begins", crossing(begins)}, {"table_ends", crossing(ends)}};
}

void PositionFunction::guard_values(double x, const double *history, double *g) const
{
  if (n_guards() == 0)
    return;
  if (spline_)
  {
    g[begins] = x - spline_->begin();
    g[ends]   = x - spline_->end();
    return;
  }
  const int    n_kinks = formula_.n_kinks();
  const double inner   = period_ ? x - periods(x, history) * period_->length : x;
  FormulaKinks(formula_).guard_values(&inner, history, g);
  if (!counts_periods())
    return;
  g[n_kinks]     = inner - (period_->begin + period_->length);
  g[n_kinks + 1] = inner - period_->begin;
}

void PositionFunction::transition(int i, double x, double rate, double *history) const
{
  if (spline_)
  {
    history[i] = -history[i];
    return;
  }
  const int n_kinks = formula_.n_kinks();
  double    inner   = period_ ? x - periods(x, history) * period_->length : x;
  if (i < n_kinks)
  {
    FormulaKinks(formula_).transition(i, &inner, &rate, history);
    return;
  }
  history[n_kinks] += i == n_kinks ? 1. : -1.;
  inner = x - history[n_kinks] * period_->length;
  FormulaKinks(formula_).start(&inner, &rate, history);
}

} // namespace gestell::mechanism
