#include "apps/session/story/turning_points.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace gestell::apps
{

namespace
{

/// Instants of extremes of y between which y changes by more than a threshold.
std::vector<double> turning_points(const std::vector<double> &t, const std::vector<double> &y, double threshold)
{
  std::vector<double> turns;
  std::size_t         high = 0, low = 0;
  int                 goes = 0; // 1 up, -1 down, 0 unknown
  for (std::size_t i = 1; i < y.size(); ++i)
  {
    high = y[i] > y[high] ? i : high;
    low  = y[i] < y[low] ? i : low;
    if (goes >= 0 && y[high] - y[i] > threshold)
    {
      turns.push_back(t[high]);
      goes = -1;
      low  = i;
    }
    else if (goes <= 0 && y[i] - y[low] > threshold)
    {
      turns.push_back(t[low]);
      goes = 1;
      high = i;
    }
  }
  return turns;
}

} // namespace

Swing swing_at(const std::vector<double> &t, const std::vector<double> &y, double at)
{
  if (y.size() < 3)
    return {};
  const auto [low, high]      = std::minmax_element(y.begin(), y.end());
  constexpr double small_turn = 0.2; // of the range: smaller swings ride on larger ones
  const auto       turns      = turning_points(t, y, small_turn * (*high - *low));
  if (turns.empty())
    return {};
  const auto nearest = std::min_element(turns.begin(), turns.end(),
                                        [&](double a, double b) { return std::abs(a - at) < std::abs(b - at); });
  Swing      swing{0., *nearest, *nearest};
  const auto take = [&](double other)
  {
    if (swing.half == 0. || std::abs(other - *nearest) < swing.half)
      swing = {std::abs(other - *nearest), *nearest, other};
  };
  if (nearest != turns.begin())
    take(*(nearest - 1));
  if (nearest + 1 != turns.end())
    take(*(nearest + 1));
  return swing;
}

double half_period_at(const std::vector<double> &t, const std::vector<double> &y, double at)
{
  return swing_at(t, y, at).half;
}

} // namespace gestell::apps
