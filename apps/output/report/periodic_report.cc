#include "apps/output/report/periodic_report.h"

#include "apps/output/charts/chart.h"
#include "apps/output/text/html.h"
#include "apps/output/text/svg.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gestell::apps
{
namespace
{

constexpr std::size_t most_solutions = 12, most_response_charts = 6;
constexpr int         circle_points = 180;

std::string stability_of(const coupling::PeriodicSolution &solution)
{
  return !solution.stability_is_known() ? "unknown" : solution.stable() ? "stable" : "unstable";
}

std::string solutions_table(const PeriodicResult &result)
{
  HtmlTable   table({"#no.", "motion", "#period [s]", "stability", "#largest multiplier", "#closes to", "found by"});
  std::size_t number = 0;
  for (const PeriodicEntry &entry : result.entries)
    if (++number <= most_solutions)
      table.add({std::to_string(number), kind_of(entry.solution), short_text(entry.solution.period, 9),
                 peak(stability_of(entry.solution), stability_of(entry.solution) == "unstable"),
                 short_text(entry.solution.largest_multiplier(), 5), short_text(entry.solution.residual, 2),
                 entry.solution.method});
  std::string html = table.html();
  if (number > most_solutions)
    html += "<p class=\"soft\">The first " + std::to_string(most_solutions) + " of " + std::to_string(number) +
            "; all stand in solutions.csv.</p>\n";
  return html;
}

std::string notes_of(const PeriodicResult &result)
{
  std::string html;
  const auto  add = [&](const std::string &text) { html += "<li>" + escape_xml(text) + "</li>\n"; };
  for (std::size_t i = 0; i < std::min(result.entries.size(), most_solutions); ++i)
    for (const std::string &note : result.entries[i].solution.notes)
      add("no. " + std::to_string(i + 1) + ": " + note);
  for (const std::string &note : result.notes)
    add(note);
  if (!result.failure.empty())
    add(result.failure);
  return html.empty() ? "" : "<ul>" + html + "</ul>\n";
}

/// Multipliers of all solutions shown, and the unit circle.
Chart multiplier_chart(const PeriodicResult &result)
{
  Chart chart;
  chart.title   = "Floquet multipliers";
  chart.note    = "inside the circle a disturbance dies away";
  chart.width   = 372.;
  chart.height  = 320.;
  chart.x.label = "real part";
  chart.y.label = "imaginary part";
  Curve circle;
  circle.colour = 6;
  for (int k = 0; k <= circle_points; ++k)
    circle.add(std::cos(2. * M_PI * k / circle_points), std::sin(2. * M_PI * k / circle_points));
  chart.panels[0].curves.push_back(circle);
  double reach  = 1.1;
  Curve  inside = rings("stable", 0), outside = rings("unstable", 3);
  for (std::size_t i = 0; i < std::min(result.entries.size(), most_solutions); ++i)
  {
    const coupling::PeriodicSolution &solution = result.entries[i].solution;
    for (const auto &mu : solution.multipliers)
    {
      (solution.stable() ? inside : outside).add(mu.real(), mu.imag());
      reach = std::max(reach, 1.1 * std::abs(mu));
    }
  }
  for (const Curve &curve : {inside, outside})
    if (!curve.x.empty())
      chart.panels[0].curves.push_back(curve);
  chart.x.begin = chart.y.begin = -reach;
  chart.x.end = chart.y.end = reach;
  return chart;
}

/// Amplitudes of the drive's harmonics of one solution, each signal against its largest.
Chart harmonics_chart(const PeriodicEntry &entry, std::size_t number)
{
  Chart chart;
  chart.title   = "Harmonics of solution " + std::to_string(number);
  chart.note    = "amplitudes, each signal against its largest one";
  chart.width   = 480.;
  chart.height  = 320.;
  chart.x.label = "multiple of the drive's frequency";
  chart.y.label = "share";
  chart.x.begin = 0.5;
  chart.x.end   = 10.8;
  for (const SignalOrbit &signal : entry.signals)
  {
    const double largest =
        signal.amplitude.empty() ? 0. : *std::max_element(signal.amplitude.begin(), signal.amplitude.end());
    Curve bars;
    bars.name = signal.name;
    for (std::size_t k = 0; largest > 0. && k < signal.amplitude.size(); ++k)
    {
      // A bar is a line from the axis and back, beside those of the other signals.
      const double x =
          double(k + 1) + 0.6 * (double(&signal - entry.signals.data()) / double(entry.signals.size()) - 0.4);
      bars.add(x, 0.);
      bars.add(x, signal.amplitude[k] / largest);
      bars.add(x, std::numeric_limits<double>::quiet_NaN());
    }
    if (!bars.x.empty())
      chart.panels[0].add(bars);
  }
  for (Curve &curve : chart.panels[0].curves)
    curve.line = LineStyle::full;
  return chart;
}

/// Largest and smallest value of a signal over the parameter; unstable motions dashed.
Chart response_chart(const PeriodicResult &result, std::size_t signal)
{
  Chart       chart;
  const auto &of = result.entries.front().signals[signal];
  chart.title    = of.name + " of the periodic motions";
  chart.note     = "largest and smallest value; unstable motions dashed; rings: special points";
  chart.width    = 880.;
  chart.height   = 300.;
  chart.x.label  = result.parameter + (result.parameter_unit.empty() ? "" : " [" + result.parameter_unit + "]");
  chart.y.label  = of.name + " [" + of.unit + "]";
  for (const bool largest : {true, false})
    for (const bool stable : {true, false})
    {
      Curve curve;
      curve.name                  = !largest ? "" : stable ? "stable" : "unstable";
      curve.colour                = stable ? 0 : 3;
      curve.line                  = stable ? LineStyle::full : LineStyle::dashed;
      const PeriodicEntry *before = nullptr;
      for (const PeriodicEntry &entry : result.entries)
      {
        const auto value = [&](const PeriodicEntry &at)
        { return largest ? at.signals[signal].max : at.signals[signal].min; };
        const bool goes_on = before && before->branch == entry.branch;
        const bool here = entry.solution.stable() == stable, was = goes_on && before->solution.stable() == stable;
        if (!here && !was)
          curve.add(entry.parameter, std::numeric_limits<double>::quiet_NaN());
        else
        {
          if (!goes_on)
            curve.add(entry.parameter, std::numeric_limits<double>::quiet_NaN());
          else if (here && !was)
            curve.add(before->parameter, value(*before));
          if (here)
            curve.add(entry.parameter, value(entry));
        }
        before = &entry;
      }
      if (std::any_of(curve.y.begin(), curve.y.end(), [](double y) { return !std::isnan(y); }))
        chart.panels[0].curves.push_back(curve);
    }
  Curve special = rings("", 5);
  for (const SpecialPoint &point : result.special_points)
  {
    special.add(point.parameter, result.entries[std::size_t(point.solution) - 1].signals[signal].max);
    special.notes.push_back({point.kind + " at " + short_text(point.parameter, 8)});
  }
  if (!special.x.empty())
    chart.panels[0].curves.push_back(special);
  return chart;
}

std::string special_table(const PeriodicResult &result)
{
  if (result.special_points.empty())
    return "";
  HtmlTable table({"special point", "#" + result.parameter, "#period [s]"});
  for (const SpecialPoint &point : result.special_points)
    table.add({point.kind, short_text(point.parameter, 9), short_text(point.period, 9)});
  return table.html();
}

std::string checks_text(const PeriodicResult &result)
{
  std::string html;
  for (const PeriodicCheck &check : result.checks)
  {
    html += "<p>Computed a second way, by " + check.method + ": ";
    if (!check.failure.empty())
      html += escape_xml(check.failure);
    for (const auto &[name, distance] : check.distances)
      html += escape_xml(name) + " differs by " + short_text(distance, 2) + " of its amplitude; ";
    html += "</p>\n";
  }
  return html;
}

} // namespace

std::string periodic_section(const Result &result, Pictures &pictures)
{
  if (!result.periodic)
    return "";
  const PeriodicResult &periodic = *result.periodic;
  std::string           html     = "<p>By " + periodic.method + ": " + escape_xml(periodic.reason) + ".</p>\n";
  const auto            show     = [&](const std::string &name, const Chart &chart)
  {
    pictures.emplace_back(name, chart_svg(chart));
    html += figure(pictures.back().second);
  };
  if (!periodic.parameter.empty() && !periodic.entries.empty())
    for (std::size_t j = 0; j < std::min(periodic.entries.front().signals.size(), most_response_charts); ++j)
      show("periodic-response-" + std::to_string(j + 1), response_chart(periodic, j));
  html += special_table(periodic) + solutions_table(periodic) + notes_of(periodic) + checks_text(periodic);
  if (!periodic.entries.empty())
  {
    html += "<div class=\"row\">";
    show("periodic-multipliers", multiplier_chart(periodic));
    if (!periodic.entries.front().signals.empty())
      show("periodic-harmonics", harmonics_chart(periodic.entries.front(), 1));
    html += "</div>\n";
  }
  return section("periodic", "Periodic motions", html);
}

} // namespace gestell::apps
