#include "apps/output/report/comparison_report.h"

#include "apps/output/charts/mode_charts.h"
#include "apps/output/charts/overlay_charts.h"
#include "apps/output/charts/shape_pairs.h"
#include "apps/output/interactive/live_chart.h"
#include "apps/output/tables/comparison_table.h"
#include "apps/output/tables/noise.h"
#include "apps/output/text/change_text.h"
#include "apps/output/text/html.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{

namespace
{

constexpr std::size_t most_copies = 4; ///< of curves that are shown without script, too

std::string deviation(double ratio)
{
  return std::isnan(ratio) ? "" : short_text(100. * (ratio - 1.), 2) + " %";
}

/// Where what is seen of a mode is more than its kinetic energy.
std::string seen_text(const coupling::ModeComparison &match)
{
  const double most = std::max(match.seen_a.maxCoeff(), match.seen_b.maxCoeff());
  return most > 1.0005
             ? "<p>Modes are fewer than what moves: <em>seen</em> is a weight then, which may exceed 100 %, and "
               "no part of the kinetic energy.</p>\n"
             : "";
}

std::string pairs_html(const ComparedShapes &shapes)
{
  HtmlTable table(
      {"#mode", "#f [Hz]", "#other mode", "#f [Hz]", "#other higher by", "#MAC", "#seen", "#seen of the other"});
  for (const coupling::ModePair &pair : shapes.match.pairs)
    table.add({std::to_string(pair.a + 1), short_text(shapes.a.modes[std::size_t(pair.a)].frequency_hz, 6),
               std::to_string(pair.b + 1), short_text(shapes.b.modes[std::size_t(pair.b)].frequency_hz, 6),
               deviation(frequency_ratio(shapes, pair)), short_text(pair.assurance, 4),
               gestell::percent(shapes.match.seen_a[pair.a]), gestell::percent(shapes.match.seen_b[pair.b])});
  return table.html() + seen_text(shapes.match);
}

std::string mac_html(const ComparedShapes &shapes)
{
  std::vector<std::string> heads{"#MAC"};
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
  return table.html();
}

std::string extremes_html(const coupling::RunResult &run, const ComparedRun &other)
{
  HtmlTable table(
      {"signal", "unit", "#largest", "#there", "#change of magnitude", "#smallest", "#there", "#change of magnitude"});
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
  return table.html();
}

} // namespace

std::string compared_run_section(const Result &result, Pictures &pictures)
{
  if (!result.run || !result.compared_run)
    return "";
  const ComparedRun &other = *result.compared_run;
  std::string        html  = "<p>Largest and smallest values of <strong>" + escape_xml(result.scene) +
                     "</strong> beside those of "
                     "<strong>" +
                     escape_xml(other.scene) + "</strong>, and its signals over the time.</p>\n" +
                     extremes_html(*result.run, other);
  const std::size_t before = pictures.size();
  for (const SignalChart &chart : overlay_charts(result.scene, *result.run, other))
  {
    pictures.emplace_back(chart.name, chart.svg);
    const ChartLink link = chart.is_part ? ChartLink::cursor : ChartLink::time;
    html += pictures.size() - before <= most_copies ? live_figure(chart.chart, chart.svg, link)
                                                    : live_figure_of_file(chart.chart, chart.svg, chart.name, link);
  }
  return section("compared-run", "The run beside that of " + escape_xml(other.scene), html);
}

std::string compared_modes_section(const Result &result, Pictures &pictures)
{
  if (!result.compared_shapes)
    return "";
  const ComparedShapes &shapes = *result.compared_shapes;
  std::string           html =
      "<p>Modes of <strong>" + escape_xml(shapes.a.scene) + "</strong> (rows) beside those of <strong>" +
      escape_xml(shapes.b.scene) + "</strong> (columns), matched by their motions at " +
      count_text(shapes.measures.size(), "measure") +
      " that both have, each weighed with its apparent mass. <em>Seen</em> is the part of a mode's kinetic energy that "
      "these tell; a mode that hardly shows in them has no partner.</p>\n" +
      pairs_html(shapes);
  if (const std::string svg = shape_pairs_svg(shapes, angle_arm(result)); !svg.empty())
  {
    pictures.emplace_back("modes-compared", svg);
    html += figure(svg);
  }
  return section("compared-modes", "Modes beside those of " + escape_xml(shapes.b.scene), html + mac_html(shapes));
}

} // namespace gestell::apps
