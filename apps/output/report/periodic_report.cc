#include "apps/output/report/periodic_report.h"

#include "apps/output/report/periodic_charts.h"
#include "apps/output/tables/periodic_tables.h"
#include "apps/output/text/html.h"
#include "apps/output/text/svg.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cctype>

namespace gestell::apps
{
namespace
{

constexpr std::size_t most_solutions = 12; ///< rows of a page; the files have all

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

std::string sentence(std::string text)
{
  text[0] = char(std::toupper(static_cast<unsigned char>(text[0])));
  return escape_xml(text) + '.';
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
  const auto            show     = [&](const std::string &name, const Chart &chart, const std::string &caption = "")
  {
    pictures.emplace_back(name, chart_svg(chart));
    html += figure(pictures.back().second, caption);
  };
  const auto show_planes = [&](const std::string &name, const std::vector<PhasePlane> &planes, const auto &chart)
  {
    for (std::size_t j = 0; j < planes.size(); ++j)
    {
      html += j % 2 == 0 ? "<div class=\"row\">" : "";
      show(name + std::to_string(j + 1), chart(planes[j]));
      html += j % 2 == 1 || j + 1 == planes.size() ? "</div>\n" : "";
    }
  };
  constexpr std::size_t most_response_charts = 6; // signals; the file has all
  if (!periodic.parameter.empty() && !periodic.entries.empty())
    for (std::size_t j = 0; j < std::min(periodic.entries.front().signals.size(), most_response_charts); ++j)
    {
      show("periodic-response-" + std::to_string(j + 1), response_chart(periodic, j));
      show("periodic-amplitude-" + std::to_string(j + 1), amplitude_chart(periodic, j));
    }
  html += special_table(periodic) + solutions_table(periodic) + notes_of(periodic) + checks_text(periodic);
  if (periodic.long_run)
    html += "<p>" + sentence(long_run_text(*periodic.long_run)) + "</p>\n";
  if (periodic.long_run)
    show_planes("periodic-section-", periodic.long_run->planes,
                [&](const PhasePlane &plane) { return section_chart(plane, periodic.long_run->motion.periods); });
  show_planes("periodic-phase-", periodic.planes, phase_plane_chart);
  if (periodic.basins)
  {
    html += "<p>" + sentence(basins_text(*periodic.basins)) + "</p>\n";
    show("periodic-basins", basins_chart(*periodic.basins));
  }
  if (!periodic.entries.empty())
  {
    html += "<div class=\"row\">";
    show("periodic-multipliers", multiplier_chart(periodic.entries, most_solutions));
    if (!periodic.entries.front().signals.empty())
      show("periodic-harmonics", harmonics_chart(periodic.entries.front(), 1), not_barred(periodic.entries.front()));
    html += "</div>\n";
  }
  return section("periodic", "Periodic motions", html);
}

} // namespace gestell::apps
