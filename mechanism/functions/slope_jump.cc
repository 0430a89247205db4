#include "mechanism/functions/slope_jump.h"

#include <cmath>
#include <vector>

namespace gestell::mechanism
{

namespace
{

/// Argument just past the zero of guard i, which is negative at `low` and positive at `high` (times `sign`).
double crossing(const PositionFunction &f, int i, double sign, double low, double high, const double *history)
{
  std::vector<double> g(std::size_t(f.n_guards()));
  for (int k = 0; k < 60; ++k)
  {
    const double middle = 0.5 * (low + high);
    f.guard_values(middle, history, g.data());
    (sign * g[std::size_t(i)] > 0. ? high : low) = middle;
  }
  return high;
}

std::optional<SlopeJump> jump_between(const PositionFunction::Value &before, const PositionFunction::Value &after)
{
  if (differ(before.value, after.value))
    return SlopeJump{"", "the value", before.value, after.value};
  if (differ(before.first, after.first))
    return SlopeJump{"", "the slope", before.first, after.first};
  return {};
}

} // namespace

bool differ(double before, double after)
{
  constexpr double rounded = 1e-6, relative = 1e-5; // of slopes that are quotients of numbers with ten digits
  return std::abs(after - before) > rounded + relative * (std::abs(before) + std::abs(after));
}

std::optional<SlopeJump> first_jump(const PositionFunction &f, double from, double to)
{
  std::vector<double> history(std::size_t(f.n_history())), g(std::size_t(f.n_guards()));
  f.start(from, 1., history.data());
  double        x       = from;
  constexpr int n_steps = 1000; // a guard that opens and closes within a thousandth of the range is not seen
  for (int k = 1; k <= n_steps; ++k)
  {
    const double end = from + (to - from) * k / n_steps;
    for (int passed = 0; passed <= f.n_guards(); ++passed)
    {
      const auto guards = f.guards(history.data());
      f.guard_values(end, history.data(), g.data());
      int    first = -1;
      double at    = end;
      for (int i = 0; i < int(guards.size()); ++i)
      {
        const double sign = guards[std::size_t(i)].crossing == Crossing::rising ? 1. : -1.;
        if (!(sign * g[std::size_t(i)] > 0.))
          continue;
        const double where = crossing(f, i, sign, x, end, history.data());
        if (first < 0 || where < at)
          first = i, at = where;
      }
      if (first < 0)
        break;
      const auto before = f.at(at, history.data());
      f.transition(first, at, 1., history.data());
      if (auto jump = jump_between(before, f.at(at, history.data())))
      {
        jump->kink = guards[std::size_t(first)].kind;
        jump->x    = at;
        return jump;
      }
      x = at;
    }
    x = end;
  }
  return {};
}

} // namespace gestell::mechanism
