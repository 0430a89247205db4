#include "apps/analysis/comparison/comparison_sections.h"

#include "apps/analysis/comparison/comparison_table.h"
#include "apps/analysis/comparison/run_comparison.h"
#include "apps/analysis/comparison/shape_pairs.h"
#include "apps/output/charts/mode_charts.h"
#include "apps/output/charts/signal_charts.h"
#include "apps/output/report/section.h"
#include "apps/output/tables/noise.h"
#include "apps/output/text/change_text.h"
#include "apps/output/values/result.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace gestell::apps
{

namespace
{

/// Column j of the history over the time, times the factor of a unit.
Curve history_curve(const std::string &name, const coupling::RunResult &run, std::size_t j, double factor)
{
  Curve             curve;
  const std::size_t width = run.columns.size();
  curve.name              = name;
  for (std::size_t i = 0; i + width <= run.rows.size(); i += width)
    curve.add(run.rows[i], factor * run.rows[i + j]);
  return curve;
}

double size_of(const coupling::SignalSummary &signal)
{
  return std::max(std::abs(signal.min), std::abs(signal.max));
}

Chart overlay(const std::string &scene, const coupling::RunResult &run, const ComparedRun &other, SharedSignal shared)
{
  const coupling::SignalSummary &a = run.signals[shared.a], &b = other.run.signals[shared.b];
  const DisplayUnit              unit = display_unit(a.unit, std::max(size_of(a), size_of(b)));
  Chart                          chart;
  chart.width            = 880.;
  chart.height           = 230.;
  chart.title            = a.name;
  chart.x.label          = "t [s]";
  chart.y.label          = "[" + unit.unit + "]";
  Curve first            = history_curve(scene, run, shared.a + 1, unit.factor),
        second           = history_curve(other.scene, other.run, shared.b + 1, unit.factor);
  second.colour          = 1;
  second.line            = LineStyle::dashed;
  chart.panels[0].curves = {std::move(first), std::move(second)};
  return chart;
}

/// The signals that two runs share, one chart for each of the first few: full lines for the first run, dashed lines for
/// the other. Forces that the main shock of the first run excites get a second chart around it.
std::vector<Section::Drawing> overlay_charts(const std::string &scene, const coupling::RunResult &run,
                                             const ComparedRun &other)
{
  using Shown = Section::Drawing::Shown;
  std::vector<Section::Drawing> charts;
  // curves that are shown without script, too: they take most of the page's size
  constexpr std::size_t most_copies = 4;
  const auto            add         = [&](const std::string &name, const Chart &chart, ChartLink link) {
    charts.push_back({name, chart, link, charts.size() < most_copies ? Shown::live : Shown::named});
  };
  if (run.rows.size() < 2 * run.columns.size() || other.run.rows.size() < 2 * other.run.columns.size())
    return charts;
  const auto  shock = main_shock(run);
  std::size_t n     = 0;
  for (const SharedSignal shared : shared_signals(run, other.run))
  {
    constexpr std::size_t most_overlays = 8; // a screen each; the file of the comparison has all signals
    if (++n > most_overlays)
      break;
    Chart      chart  = overlay(scene, run, other, shared);
    const auto number = std::to_string(n);
    const bool force  = run.signals[shared.a].unit == "N" || run.signals[shared.a].unit == "N m";
    add("compared-" + number, chart, ChartLink::time);
    if (!force || !(shock.second > shock.first))
      continue;
    chart.title += ", around the main shock";
    std::tie(chart.x.begin, chart.x.end) = shock;
    add("compared-" + number + "-shock", chart, ChartLink::cursor);
  }
  return charts;
}

std::string deviation(double ratio)
{
  return std::isnan(ratio) ? "" : short_text(100. * (ratio - 1.), 2) + " %";
}

HtmlTable pairs_table(const ComparedShapes &shapes)
{
  HtmlTable table({"#mode", "#frequency [Hz]", "#other mode", "#other frequency [Hz]", "#frequency difference", "#MAC",
                   "#observability", "#other observability"});
  for (const coupling::ModePair &pair : shapes.match.pairs)
    table.add({std::to_string(pair.a + 1), short_text(shapes.a.modes[std::size_t(pair.a)].frequency_hz, 6),
               std::to_string(pair.b + 1), short_text(shapes.b.modes[std::size_t(pair.b)].frequency_hz, 6),
               deviation(frequency_ratio(shapes, pair)), short_text(pair.assurance, 4),
               gestell::percent(shapes.match.seen_a[pair.a]), gestell::percent(shapes.match.seen_b[pair.b])});
  return table;
}

HtmlTable mac_table(const ComparedShapes &shapes)
{
  std::vector<std::string> heads{"#MAC: " + shapes.a.scene + " by " + shapes.b.scene};
  for (const coupling::Mode &mode : shapes.b.modes)
    heads.push_back("#" + short_text(mode.frequency_hz) + " Hz");
  HtmlTable table(heads);
  for (std::size_t i = 0; i < shapes.a.modes.size(); ++i)
  {
    std::vector<HtmlTable::Cell> row{short_text(shapes.a.modes[i].frequency_hz) + " Hz"};
    for (Eigen::Index j = 0; j < shapes.match.mac.cols(); ++j)
    {
      const double mac = shapes.match.mac(Eigen::Index(i), j);
      const bool   matched =
          std::any_of(shapes.match.pairs.begin(), shapes.match.pairs.end(),
                      [&](const coupling::ModePair &pair) { return pair.a == int(i) && pair.b == int(j); });
      row.push_back(peak(short_text(std::round(100. * mac) / 100., 2), matched));
    }
    table.add(row);
  }
  return table;
}

HtmlTable extremes_table(const coupling::RunResult &run, const ComparedRun &other)
{
  HtmlTable   table({"signal", "unit", "#maximum", "#other maximum", "#other magnitude", "#minimum", "#other minimum",
                     "#other magnitude"});
  const Noise noise = noise_of(run.signals);
  for (const SharedSignal shared : shared_signals(run, other.run))
  {
    const coupling::SignalSummary &a = run.signals[shared.a], &b = other.run.signals[shared.b];
    const double      size   = std::max({std::abs(a.min), std::abs(a.max), std::abs(b.min), std::abs(b.max)});
    const DisplayUnit unit   = display_unit(a.unit, size);
    const auto        text   = [&](double x) { return short_text(noise.without(a.unit, x) * unit.factor, 5); };
    const auto        clean  = [&](double x) { return noise.without(a.unit, x); };
    const auto        change = [&](double x, double y) { return change_text(clean(x), clean(y)); };
    table.add({a.name, unit.unit, text(a.max), text(b.max), peak(change(a.max, b.max)), text(a.min), text(b.min),
               peak(change(a.min, b.min))});
  }
  return table;
}

} // namespace

std::vector<Section> sections_of(const Result &result, const ComparedRun &other)
{
  Section section{"compared-run", "Comparison with the run of " + other.scene, "Runs compared",
                  Section::Place::results};
  section.parts.push_back(Section::Sentences{"Extremes and signals compared with " + other.scene + "."});
  section.parts.push_back(extremes_table(*result.run, other));
  for (Section::Drawing &chart : overlay_charts(result.scene, *result.run, other))
    section.parts.push_back(std::move(chart));
  return {section};
}

std::vector<Section> sections_of(const Result &result, const ComparedShapes &shapes)
{
  Section section{"compared-modes", "Comparison with the modes of " + shapes.b.scene, "Modes compared",
                  Section::Place::frequencies};
  const coupling::ModeComparison &match = shapes.match;
  section.parts.push_back(Section::Sentences{
      "Modes of " + shapes.a.scene + " and of " + shapes.b.scene + " (columns \"other\"), matched by " +
      count_text(shapes.measures.size(), "shared measure") +
      " that are weighted with their apparent masses. Observability is the share of a mode's kinetic energy in these "
      "measures; "
      "a mode with low observability has no match." +
      (std::max(match.seen_a.maxCoeff(), match.seen_b.maxCoeff()) > 1.0005
           ? " Some motions of the measures are not combinations of these modes, so observability may exceed 100 %."
           : "")});
  section.parts.push_back(pairs_table(shapes));
  const std::size_t pairs = match.pairs.size();
  section.parts.push_back(Section::Sentences{"modes without a match: " + std::to_string(shapes.a.modes.size() - pairs) +
                                             " of the first, " + std::to_string(shapes.b.modes.size() - pairs) +
                                             " of the other"});
  if (const std::string svg = shape_pairs_svg(shapes, angle_arm(result)); !svg.empty())
    section.parts.push_back(Section::Picture{"modes-compared", svg});
  section.parts.push_back(Section::PageTable{mac_table(shapes)});
  return {section};
}

} // namespace gestell::apps
