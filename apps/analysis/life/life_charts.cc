#include "apps/analysis/life/life_charts.h"

#include "apps/output/text/svg.h"
#include "apps/output/values/colours.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{
namespace
{

constexpr double      mega_pascal = 1e-6;
constexpr std::size_t drawn       = 200; ///< cycles: more rings cover each other

/// Range of a mean that does the damage of the cut-off: bisection, as the equivalent range grows with the range.
double endured_range(const DamageRule &rule, double mean)
{
  double low = 0., high = 2. * rule.curve.cut_off();
  if (!(rule.equivalent_range({high, mean, 1.}) > rule.curve.cut_off()))
    return high;               // far in compression
  constexpr int halvings = 40; // to 1e-12
  for (int k = 0; k < halvings; ++k)
    (rule.equivalent_range({0.5 * (low + high), mean, 1.}) > rule.curve.cut_off() ? high : low) = 0.5 * (low + high);
  return 0.5 * (low + high);
}

/// Place of a cell in the picture of a matrix.
struct CellMap
{
  double left = 64., top = 30., wide = 420., high = 300.;
  double cell_wide, cell_high;

  explicit CellMap(const Eigen::MatrixXd &counts)
      : cell_wide(wide / double(counts.cols())), cell_high(high / double(counts.rows()))
  {
  }
  double x(double column) const { return left + column * cell_wide; }
  double y(double row) const { return top + high - row * cell_high; }
};

/// Grey without damage.
std::string cell_colour(double damage, double most)
{
  return damage > 0. ? hex(scale_colour(shade_of(damage, most))) : "#b0b0b0";
}

} // namespace

double shade_of(double damage, double most)
{
  return damage > 0. ? std::clamp(1. + std::log10(damage / most) / shaded_decades, 0., 1.) : 0.;
}

Chart life_history_chart(const LifeResult &found)
{
  Chart chart;
  chart.width   = 880.;
  chart.title   = "Stress at the worst place";
  chart.note    = "rings: turning points of the most damaging cycles";
  chart.x.label = "t [s]";
  chart.y.label = "stress [MPa]";
  Curve stress{"stress"};
  for (std::size_t k = 0; k < found.t.size(); ++k)
    stress.add(found.t[k], mega_pascal * found.stress[k]);
  Curve                 turns   = rings("cycles", 1);
  constexpr std::size_t telling = 10; // as in the table of cycles
  for (std::size_t k = 0; k < std::min(telling, found.cycles.size()); ++k)
  {
    const LifeCycle &x = found.cycles[k];
    for (const auto &[t, sign] : {std::pair(x.begin, -0.5), std::pair(x.end, 0.5)})
      if (const auto at = std::lower_bound(found.t.begin(), found.t.end(), t); at != found.t.end() && *at == t)
      {
        turns.add(t, mega_pascal * found.stress[std::size_t(at - found.t.begin())]);
        turns.notes.push_back(
            {"range " + short_text(mega_pascal * x.range) + " MPa, damage " + short_text(x.damage, 3)});
      }
  }
  chart.panels[0].curves = {std::move(stress), std::move(turns)};
  return chart;
}

std::string range_mean_picture(const LifeResult &found)
{
  const RangeMeanMatrix &m = found.matrix;
  if (m.counts.size() == 0)
    return "";
  const CellMap map(m.counts);
  const double  most = m.damage.maxCoeff();
  std::string   svg  = svg_head(map.left + map.wide + 20., map.top + map.high + 50., "Range-mean matrix");
  svg += svg_text(map.left, 16., "Damage by range and mean", "title");
  for (Eigen::Index i = 0; i < m.counts.rows(); ++i)
    for (Eigen::Index j = 0; j < m.counts.cols(); ++j)
      if (m.counts(i, j) > 0.)
        svg += svg_hint(short_text(m.counts(i, j)) + " cycles, damage " + short_text(m.damage(i, j), 3),
                        "<rect" + svg_box(map.x(double(j)), map.y(double(i) + 1.), map.cell_wide, map.cell_high) +
                            " fill=\"" + cell_colour(m.damage(i, j), most) + "\"/>");
  svg += svg_line("axis", map.x(0.), map.y(0.), map.left + map.wide, map.y(0.)) +
         svg_line("axis", map.x(0.), map.y(0.), map.x(0.), map.top);
  constexpr int ticks = 6;
  const double  end   = m.mean_begin + m.mean_width * double(m.counts.cols());
  for (const double mean : nice_ticks(mega_pascal * m.mean_begin, mega_pascal * end, ticks))
    svg += svg_text(map.x((mean / mega_pascal - m.mean_begin) / m.mean_width), map.y(0.) + 16., short_text(mean),
                    "tick", "middle");
  for (const double range : nice_ticks(0., mega_pascal * m.range_width * double(m.counts.rows()), ticks))
    svg += svg_text(map.left - 6., map.y(range / mega_pascal / m.range_width) + 4., short_text(range), "tick", "end");
  svg += svg_text(map.left + 0.5 * map.wide, map.y(0.) + 36., "mean [MPa]", "label", "middle") +
         svg_text(16., map.top + 0.5 * map.high, "range [MPa]", "label", "middle", -90.);
  return svg + "</svg>\n";
}

Chart haigh_chart(const LifeResult &found)
{
  Chart chart;
  chart.width   = 520.;
  chart.title   = "Haigh diagram of the worst place";
  chart.note    = found.rule.curve.cut_off() > 0. ? "line: amplitude at the cut-off of the curve" : "";
  chart.x.label = "mean [MPa]";
  chart.y.label = "amplitude [MPa]";
  chart.y.begin = 0.;
  Curve  cycles = rings("cycles", 1);
  double low = 0., high = 0.;
  for (std::size_t k = 0; k < std::min(drawn, found.cycles.size()); ++k)
  {
    const LifeCycle &x = found.cycles[k];
    cycles.add(mega_pascal * x.mean, 0.5 * mega_pascal * x.range);
    cycles.notes.push_back({short_text(x.count) + " times, damage " + short_text(x.damage, 3)});
    low  = std::min(low, x.mean - 0.5 * x.range);
    high = std::max(high, x.mean + 0.5 * x.range);
  }
  chart.panels[0].curves.push_back(std::move(cycles));
  if (found.rule.curve.cut_off() > 0.)
  {
    Curve         line{"no damage"};
    constexpr int points = 60; // of kinked lines on half a page
    for (int k = 0; k <= points; ++k)
    {
      const double mean = low + (high - low) * k / points;
      line.add(mega_pascal * mean, 0.5 * mega_pascal * endured_range(found.rule, mean));
    }
    chart.panels[0].curves.push_back(std::move(line));
  }
  return chart;
}

} // namespace gestell::apps
