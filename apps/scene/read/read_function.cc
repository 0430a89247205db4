#include "apps/scene/read/read_function.h"

#include "apps/scene/read/checked.h"
#include "fem/values/number_text.h"
#include "mechanism/functions/slope_jump.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

namespace gestell::apps
{

using mechanism::PositionFunction;

namespace
{

/**
 * A spline through rows that rise after a level stretch, or have a wrong value among them, swings beyond them.  It may
 * do so only at an extreme, where the steps between rows change their sign.
 */
void warn_of_overshoot(const SceneTable &table, const std::vector<mechanism::CubicSpline::Point> &points, bool periodic,
                       const mechanism::CubicSpline &spline)
{
  const int  n    = int(points.size()) - 1;
  const auto step = [&](int i)
  {
    const int k = periodic ? (i + n) % n : std::clamp(i, 0, n - 1);
    return points[k + 1].f - points[k].f;
  };
  const auto   by_f  = [](const auto &a, const auto &b) { return a.f < b.f; };
  const auto   ends  = std::minmax_element(points.begin(), points.end(), by_f);
  const double whole = ends.second->f - ends.first->f; // range of all rows, the scale for a level stretch
  double       worst = 0., at = 0., by = 0.;
  for (int i = 0; i < n; ++i)
  {
    const double steps[]  = {step(i - 1), step(i), step(i + 1)};
    const auto [down, up] = std::minmax_element(std::begin(steps), std::end(steps));
    const double largest = std::max(std::abs(*down), std::abs(*up)), scale = largest > 0. ? largest : whole;
    if ((*down < 0. && *up > 0.) || scale == 0.)
      continue;
    constexpr int n_between = 16; // an extreme between two looks is missed by (1/32)^2 of its bend
    const auto [low, high]  = std::minmax(points[i].f, points[i + 1].f);
    for (int k = 1; k < n_between; ++k)
    {
      const double x = points[i].x + k * (points[i + 1].x - points[i].x) / n_between, f = spline.at(x).value;
      const double beyond = std::max(low - f, f - high);
      if (beyond > worst * scale)
        worst = beyond / scale, at = x, by = beyond;
    }
  }
  constexpr double seen_overshoot = 0.05; // reported overshoot of a spline, by the steps between rows there
  if (worst <= seen_overshoot)
    return;
  std::ostringstream text;
  text.precision(3);
  text << "the spline overshoots by " << by << " the adjacent rows at " << at << ", by " << 100. * worst
       << " % of the steps between rows there (of a level stretch, of what all rows range over); add rows where the "
          "curve bends, or smooth it";
  table.warn("table", text.str());
}

} // namespace

std::vector<Key> function_keys(const Kind &x, const Kind &y)
{
  return {key::formula("function", y, "formula of the argument").by_default("`table`"),
          key::composed("table", Key::Form::rows, y, {}, "rows of argument and value, interpolated by a spline")
              .by_default("`function`"),
          key::number("period", x, "period of the argument").above_zero().by_default("none"),
          key::number("rise", y, "change of the value over a period").by_default(0.),
          key::number("begin", x, "start of the period of the formula").by_default(0.)};
}

std::vector<Key> position_function_keys()
{
  std::vector<Key>       keys    = function_keys(kind::length, kind::length);
  const std::vector<Key> angular = function_keys(kind::angle, kind::angle);
  for (std::size_t i = 0; i < keys.size(); ++i)
    keys[i] = keys[i].on_angle(angular[i]);
  return keys;
}

namespace
{

/// The last row has the value of the first one and `rise`; where it is left out it is added.
void close(const SceneTable &table, const PositionFunction::Period &period,
           std::vector<mechanism::CubicSpline::Point> &points)
{
  const auto       first = points.front(), last = points.back();
  const double     end = first.x + period.length, value = first.f + period.rise;
  constexpr double as_written = 1e-9; // of the period and of the values: what few digits leave of a table that closes
  if (last.x > end + as_written * period.length)
    throw table.error("table", "covers more than one period; give the rows of one period only");
  if (last.x >= end - as_written * period.length)
  {
    double largest = std::abs(period.rise); // a last row may be zero only up to rounding, as sin 2 pi is
    for (const auto &point : points)
      largest = std::max(largest, std::abs(point.f));
    if (std::abs(last.f - value) > as_written * largest)
      throw table.error("table", "does not close: its last row, one period after the first, is " + short_text(last.f) +
                                     ", but must be the value of the first row plus 'rise', " + short_text(value) +
                                     "; correct this row or remove it");
    points.back().f = value;
  }
  else
    points.push_back({end, value});
}

} // namespace

std::shared_ptr<const PositionFunction> read_function(const SceneTable &table, const Variable &variable, const Kind &x,
                                                      const Kind &y)
{
  const bool formula = table.has("function");
  if (formula == table.has("table"))
    throw table.error("needs either 'function', a formula of " + variable.name + ", or 'table', rows of two values");
  std::optional<PositionFunction::Period> period;
  if (table.has("period"))
  {
    period.emplace();
    period->length = table.positive("period", x);
    period->rise   = table.number("rise", y, 0.);
    if (formula)
      period->begin = table.number("begin", x, 0.);
  }
  if (formula)
  {
    const auto f = table.formula("function", {variable}, y);
    return checked(table, [&] { return std::make_shared<PositionFunction>(f, period); });
  }
  using mechanism::CubicSpline;
  std::vector<CubicSpline::Point> points;
  for (const auto &row : table.pairs("table", x, y))
    points.push_back({row[0], row[1]});
  if (period)
    close(table, *period, points);
  const auto ends = period ? CubicSpline::Ends::periodic : CubicSpline::Ends::not_a_knot;
  try
  {
    const CubicSpline spline(points, ends);
    warn_of_overshoot(table, points, period.has_value(), spline);
    return std::make_shared<PositionFunction>(spline);
  }
  catch (const std::invalid_argument &e)
  {
    throw table.error("table", e.what());
  }
}

void refuse_jumps(const SceneTable &table, const PositionFunction &f, const Kind &x)
{
  if (!table.has("function") || !table.has("period"))
    return; // how far it is used is not known; where it jumps the run ends
  const double period = table.positive("period", x), begin = table.number("begin", x, 0.);
  const double aside = 1e-3 * period; // kinks often lie at the start: no step of the search should end on one
  const auto   jump  = mechanism::first_jump(f, begin - M_SQRT1_2 * aside, begin + period - M_SQRT1_2 * aside);
  if (!jump)
    return;
  const bool         turns = x.refused == Counts::turns;
  const double       at    = std::round(1e9 * jump->x / period) / 1e9 * period + 0.; // located to rounding
  std::ostringstream text;
  text << jump->what << " jumps from " << jump->before << " to " << jump->after << " at "
       << (turns ? at * 180. / M_PI : at) << (turns ? " deg" : "") << " (" << jump->kink
       << "), an impact that an ideal joint cannot transmit; smooth the function there, or let it act through a "
          "spring: an element on a measure of type \"position function\", instead of the joint";
  throw table.error("function", text.str());
}

} // namespace gestell::apps
