#include "apps/study/report/effect_picture.h"

#include "apps/output/text/svg.h"
#include "apps/study/report/shown_axis.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{
namespace
{

/// pixels
constexpr double tornado_width = 640., tornado_row = 22., tornado_top = 62., name_width = 170., numbers_width = 130.;

/// A row of the tornado: changes from the value at the midpoint.
struct EffectBar
{
  std::string name;
  double      low, high; ///< at from and at to; of two together -+ what they add
  bool        is_interaction;

  double width() const { return std::max({std::abs(low), std::abs(high), std::abs(high - low)}); }
};

std::vector<EffectBar> bars_of(const ResponseSurface &surface)
{
  const auto             k      = static_cast<Eigen::Index>(surface.variables.size());
  const double           middle = surface.value(Eigen::VectorXd::Zero(k));
  std::vector<EffectBar> bars;
  for (Eigen::Index i = 0; i < k; ++i)
    bars.push_back({surface.variables[i], surface.value(-Eigen::VectorXd::Unit(k, i)) - middle,
                    surface.value(Eigen::VectorXd::Unit(k, i)) - middle, false});
  for (std::size_t j = 0; j < surface.terms.size(); ++j)
    if (const SurfaceTerm &term = surface.terms[j]; term.is_interaction())
    {
      const double size = std::abs(surface.coefficients(static_cast<Eigen::Index>(j)));
      bars.push_back({surface.variables[term.first] + " × " + surface.variables[term.second], -size, size, true});
    }
  std::stable_sort(bars.begin(), bars.end(),
                   [](const EffectBar &a, const EffectBar &b) { return a.width() > b.width(); });
  return bars;
}

/// Those wide enough to be seen.
std::vector<EffectBar> widest(std::vector<EffectBar> bars)
{
  constexpr double least_of_largest = 0.005; // narrower bars are not drawn
  const double     least            = bars.empty() ? 0. : least_of_largest * bars.front().width();
  const auto end = std::find_if(bars.begin(), bars.end(), [&](const EffectBar &bar) { return bar.width() < least; });
  bars.erase(end, bars.end());
  constexpr std::size_t most_bars = 12; // the table has all
  bars.resize(std::min(bars.size(), most_bars), EffectBar());
  return bars;
}

std::string bar_svg(const std::string &colour, double from, double to, double y, double height = 14.)
{
  return "<rect class=\"" + colour + "\" rx=\"1.5\"" +
         svg_box(std::min(from, to), y + 3., std::max(std::abs(to - from), 0.5), height) + "/>";
}

/// The bars to either end, one below the other where they go to the same side.
std::string two_bars_svg(double zero, double low, double high, double y)
{
  const bool same_side = (low > zero) == (high > zero);
  return same_side ? bar_svg("f0", zero, low, y, 7.) + bar_svg("f1", zero, high, y + 7., 7.)
                   : bar_svg("f0", zero, low, y) + bar_svg("f1", zero, high, y);
}

/// With its sign; rounding of what the bar is wide is zero.
std::string signed_text(const ShownAxis &axis, double value, double width)
{
  const double rounded = std::abs(value) < 1e-9 * width ? 0. : value;
  return (rounded > 0. ? "+" : "") + axis.text(rounded, 3);
}

std::string row_svg(const EffectBar &bar, const ShownAxis &axis, const AxisMap &map, double y)
{
  const double      low = map.at(axis.shown(bar.low)), high = map.at(axis.shown(bar.high));
  const std::string bars = bar.is_interaction ? bar_svg("f5", low, high, y) : two_bars_svg(map.at(0.), low, high, y);
  const std::string numbers =
      bar.is_interaction ? "±" + axis.text(bar.high, 3)
                         : signed_text(axis, bar.low, bar.width()) + " / " + signed_text(axis, bar.high, bar.width());
  return svg_text(name_width - 8., y + 14., bar.name, "label", "end") + bars +
         svg_text(tornado_width - 8., y + 14., numbers, "tick", "end");
}

std::string legend_svg(bool has_interactions)
{
  std::string svg =
      bar_svg("f0", name_width, name_width + 16., 30.) + svg_text(name_width + 22., 44., "lower end", "label") +
      bar_svg("f1", name_width + 84., name_width + 100., 30.) + svg_text(name_width + 106., 44., "upper end", "label");
  if (has_interactions)
    svg += bar_svg("f5", name_width + 156., name_width + 172., 30.) +
           svg_text(name_width + 178., 44., "interaction of two variables", "label");
  return svg;
}

} // namespace

std::string effect_picture(const ResponseSurface &surface, double computed)
{
  const std::vector<EffectBar> all = bars_of(surface), bars = widest(all);
  const auto                   k      = static_cast<Eigen::Index>(surface.variables.size());
  const double                 middle = surface.value(Eigen::VectorXd::Zero(k));
  double                       low = 0., high = 0.;
  for (const EffectBar &bar : bars)
  {
    low  = std::min({low, bar.low, bar.high});
    high = std::max({high, bar.low, bar.high});
  }
  const ShownAxis   axis  = shown_axis(surface.output, std::max(std::abs(low), high));
  const ChartAxis   range = fitted(ChartAxis(), axis.shown(low), axis.shown(high), 0.02);
  const AxisMap     map(range, name_width + 6., tornado_width - numbers_width);
  const double      bottom = tornado_top + tornado_row * static_cast<double>(bars.size());
  const std::string title =
      "Change of " + axis.head() + " from " + shown_axis(surface.output, std::abs(middle)).text_with_unit(middle) +
      " at the midpoint" +
      (std::isfinite(computed) ? " (run: " + shown_axis(surface.output, std::abs(middle)).text(computed) + ")" : "");

  std::string svg =
      svg_head(tornado_width, bottom + (bars.size() < all.size() ? 46. : 30.), title) +
      svg_text(10., 19., title, "title") +
      legend_svg(std::any_of(bars.begin(), bars.end(), [](const auto &bar) { return bar.is_interaction; }));
  for (const Tick &tick : ticks_of(range, 5))
    svg += svg_line("grid", map.at(tick.value), tornado_top, map.at(tick.value), bottom) +
           svg_text(map.at(tick.value), bottom + 16., tick.text, "tick", "middle");
  for (std::size_t i = 0; i < bars.size(); ++i)
    svg += row_svg(bars[i], axis, map, tornado_top + tornado_row * static_cast<double>(i));
  if (bars.size() < all.size())
    svg += svg_text(10., bottom + 36., count_text(all.size() - bars.size(), "narrower bar") + " not drawn", "small");
  return svg + svg_line("axis", map.at(0.), tornado_top, map.at(0.), bottom) + "</svg>\n";
}

} // namespace gestell::apps
