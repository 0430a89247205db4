#include "apps/output/report/work_precision_page.h"

#include "apps/output/charts/work_precision_chart.h"
#include "apps/output/report/work_precision_script.h"
#include "apps/output/text/json.h"
#include "apps/output/text/report_style.h"
#include "apps/output/text/svg.h"
#include "fem/values/number_text.h"

#include <cmath>

namespace gestell::apps
{
namespace
{

std::string text_of(double x, int digits = 2)
{
  return std::isfinite(x) ? short_text(x, digits) : "–";
}

std::string setting(const WorkPoint &point)
{
  return point.step > 0. ? "step " + short_text(point.step * 1e6, 4) + " µs"
                         : "tolerance " + short_text(point.tolerance, 2);
}

std::string points_json(const WorkPrecision &chart)
{
  std::vector<bool> on_front(chart.points.size(), false);
  for (std::size_t m = 0; m < chart.models.size(); ++m)
    for (const std::size_t i : pareto_front(chart, int(m)))
      on_front[i] = true;

  Json models = Json::array(), points = Json::array();
  for (const WorkModel &model : chart.models)
    models.push_back(
        {{"coordinates", model.coordinates}, {"modes", model.modes}, {"reference", model.reference_error}});
  for (std::size_t i = 0; i < chart.points.size(); ++i)
  {
    const WorkPoint &p = chart.points[i];
    if (p.failure.empty() && std::isfinite(p.error))
      points.push_back({{"method", p.method},
                        {"family", p.family},
                        {"colour", family_colour(p.family)},
                        {"model", p.model},
                        {"own", p.own},
                        {"events", p.events},
                        {"resolved", p.resolved},
                        {"front", bool(on_front[i])},
                        {"setting", setting(p)},
                        {"lines", p.settings},
                        {"value", p.setting()},
                        {"error", p.error},
                        {"cpu", p.cpu_s},
                        {"setup", p.setup_s},
                        {"steps", p.work.steps},
                        {"rejected", p.work.rejected},
                        {"newton", p.work.newton},
                        {"factorisations", p.work.factorisations},
                        {"solves", p.work.solves},
                        {"evaluations", std::lround(work_of(p, WorkMeasure::evaluations))},
                        {"located", p.n_events}});
  }
  std::string safe;
  for (const char c : json_text({{"models", models}, {"points", points}})) // no "</script>" inside a script
    safe += c == '<' ? std::string("\\u003c") : std::string(1, c);
  return safe;
}

std::string row(const std::vector<std::string> &cells, const char *tag = "td", std::size_t first_number = 3)
{
  std::string html = "<tr>";
  for (std::size_t i = 0; i < cells.size(); ++i)
    html +=
        std::string("<") + tag + (i >= first_number ? " class=\"n\">" : ">") + escape_xml(cells[i]) + "</" + tag + ">";
  return html + "</tr>\n";
}

std::string choices(const WorkPrecision &chart, int model)
{
  const std::vector<WorkSeries> series = work_series(chart);
  std::string                   html   = "<div class=\"wide\"><table>" +
                     row({"error", "our fastest", "setting", "CPU [ms]", "fastest peer", "CPU [ms]", "ratio"}, "th");
  for (const double target : chart.targets)
  {
    const auto own  = best_at_error(chart, series, model, true, target),
               peer = best_at_error(chart, series, model, false, target);
    const auto cpu  = [](const std::optional<BestSeries> &best)
    { return best ? (best->at.bound ? "≤ " : "") + short_text(1e3 * best->at.cpu_s, 3) : std::string("–"); };
    const auto name = [](const std::optional<BestSeries> &best)
    { return best ? best->series->method + (best->series->events ? ", events" : "") : std::string("–"); };
    html += row({text_of(target), name(own), own ? setting(chart.points[own->at.point]) : "–", cpu(own), name(peer),
                 cpu(peer), own && peer ? short_text(peer->at.cpu_s / own->at.cpu_s, 3) : "–"});
  }
  return html + "</table></div>\n";
}

std::string front(const WorkPrecision &chart, int model)
{
  std::string html =
      "<div class=\"wide\"><table>" +
      row({"method", "events", "setting", "error", "CPU [ms]", "steps", "Newton", "factorisations"}, "th");
  for (const std::size_t i : pareto_front(chart, model))
  {
    const WorkPoint &p = chart.points[i];
    html +=
        row({p.method, p.events ? "located" : "passed over", setting(p), text_of(p.error), short_text(1e3 * p.cpu_s, 4),
             std::to_string(p.work.steps), std::to_string(p.work.newton), std::to_string(p.work.factorisations)});
  }
  return html + "</table></div>\n";
}

std::string model_section(const WorkPrecision &chart, int m)
{
  const WorkModel  &model = chart.models[m];
  const std::string name  = std::to_string(model.coordinates) + " coordinates" +
                           (model.modes > 0 ? ", " + std::to_string(model.modes) + " of them modes" : "");
  std::string html = "<section><h2>" + name + "</h2>\n<p>Reference: " + escape_xml(model.reference) +
                     ". Its own error is " + text_of(model.reference_error) + "; errors below " +
                     text_of(10. * model.reference_error) + " are not resolved.</p>\n";
  if (std::isfinite(model.truncation))
    html += "<p>The modes left out against the largest model are worth " + text_of(model.truncation) + ".</p>\n";
  html +=
      "<h3>Fastest at an error</h3>\n" + choices(chart, m) +
      "<p class=\"soft\">CPU times lie on the line between two runs of a method; every finer run of it stays below "
      "the error.</p>\n<h3>Pareto front</h3>\n<p class=\"soft\">No other run is both faster and more accurate than one "
      "of these.</p>\n" +
      front(chart, m) + "<noscript>" + work_precision_svg(chart, m, WorkMeasure::cpu) + "</noscript></section>\n";
  return html;
}

std::string failures(const WorkPrecision &chart)
{
  std::string html;
  for (const WorkPoint &p : chart.points)
    if (!p.failure.empty())
      html += row({p.method, p.events ? "located" : "passed over", setting(p), p.failure}, "td", 9);
  return html.empty()
             ? ""
             : "<section><h2>Runs given up</h2>\n<div class=\"scroll\"><table>" +
                   row({"method", "events", "setting", "reason"}, "th", 9) + html + "</table></div></section>\n";
}

} // namespace

std::string work_precision_page(const WorkPrecision &chart)
{
  std::string html = "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
                     "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"><title>" +
                     escape_xml("Work and precision: " + chart.scene) + "</title><style>" + report_style +
                     work_precision_style +
                     "</style></head><body>\n<h1>Work and precision: " + escape_xml(chart.scene) +
                     "</h1>\n<p class=\"lead\">" + escape_xml(chart.description) + "</p>\n";
  std::string signals;
  for (const std::string &signal : chart.signals)
    signals += (signals.empty() ? "" : ", ") + signal;
  html += "<p>Error is the root mean square over " + std::to_string(chart.n_samples) + " instants from " +
          text_of(chart.begin, 4) + " s to " + text_of(chart.end, 4) + " s of " + escape_xml(signals) +
          ", each scaled by its largest magnitude in the reference. Work is the CPU time of the stepping thread" +
          (chart.peers.empty() ? std::string() : "; peers are " + escape_xml(chart.peers) + " on the identical model") +
          ".</p>\n";
  if (!chart.notes.empty())
  {
    html += "<div class=\"warnings\" role=\"note\"><ul>";
    for (const std::string &note : chart.notes)
      html += "<li>" + escape_xml(note) + "</li>";
    html += "</ul></div>\n";
  }
  html += "<div id=\"chart\"></div>\n<script>const work = " + points_json(chart) + ";\n" + work_precision_script +
          "</script>\n";
  for (std::size_t m = 0; m < chart.models.size(); ++m)
    html += model_section(chart, int(m));
  return html + failures(chart) + "<footer>Gestell " + escape_xml(chart.version) +
         ". All runs are in chart.csv, the settings offered in chart_settings.toml.</footer></body></html>\n";
}

} // namespace gestell::apps
