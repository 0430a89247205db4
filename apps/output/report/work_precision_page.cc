#include "apps/output/report/work_precision_page.h"

#include "apps/output/charts/work_precision_chart.h"
#include "apps/output/report/work_precision_script.h"
#include "apps/output/text/html.h"
#include "apps/output/text/json.h"
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

std::string points_json(const WorkPrecision &chart)
{
  const std::vector<bool> on_front = on_pareto_front(chart);
  Json                    models = Json::array(), points = Json::array();
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
                        {"setting", setting_words(p)},
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

std::string choices(const WorkPrecision &chart, int model)
{
  const std::vector<WorkSeries> series = work_series(chart);
  HtmlTable table({"error", "fastest Gestell method", "setting", "#CPU time [ms]", "fastest other solver",
                   "#CPU time [ms]", "#ratio of CPU times"});
  for (const double target : chart.targets)
  {
    const auto own  = best_at_error(chart, series, model, true, target),
               peer = best_at_error(chart, series, model, false, target);
    const auto cpu  = [](const std::optional<BestSeries> &best)
    { return best ? (best->at.bound ? "≤ " : "") + short_text(1e3 * best->at.cpu_s, 3) : std::string("–"); };
    const auto name = [](const std::optional<BestSeries> &best)
    { return best ? best->series->method + (best->series->events ? ", events located" : "") : std::string("–"); };
    table.add({text_of(target), name(own), own ? setting_words(chart.points[own->at.point]) : "–", cpu(own), name(peer),
               cpu(peer), own && peer ? short_text(peer->at.cpu_s / own->at.cpu_s, 3) : "–"});
  }
  return table.html();
}

std::string front(const WorkPrecision &chart, int model)
{
  HtmlTable table(
      {"method", "events", "setting", "#error", "#CPU time [ms]", "#steps", "#Newton iterations", "#factorisations"});
  for (const std::size_t i : pareto_front(chart, model))
  {
    const WorkPoint &p = chart.points[i];
    table.add({p.method, p.events ? "located" : "not located", setting_words(p), text_of(p.error),
               short_text(1e3 * p.cpu_s), std::to_string(p.work.steps), std::to_string(p.work.newton),
               std::to_string(p.work.factorisations)});
  }
  return table.html();
}

std::string model_section(const WorkPrecision &chart, int m)
{
  const WorkModel  &model = chart.models[m];
  const std::string name  = std::to_string(model.coordinates) + " DOFs" +
                           (model.modes > 0 ? ", " + std::to_string(model.modes) + " of them modal" : "");
  std::string html = "<section><h2>" + name + "</h2>\n<p>Reference: " + escape_xml(model.reference) +
                     ", with an error of " + text_of(model.reference_error) + ". Errors below " +
                     text_of(10. * model.reference_error) + " are not resolved.</p>\n";
  if (std::isfinite(model.truncation))
    html += "<p>Error due to truncated modes, relative to the largest model: " + text_of(model.truncation) + ".</p>\n";
  html +=
      "<h3>Fastest method for a required error</h3>\n" + choices(chart, m) +
      "<p class=\"soft\">CPU times are interpolated between two runs of a method. All finer runs of the method have "
      "smaller errors.</p>\n<h3>Pareto front</h3>\n<p class=\"soft\">Runs for which no other run is both faster "
      "and more accurate.</p>\n" +
      front(chart, m) + "<noscript>" + work_precision_svg(chart, m, WorkMeasure::cpu) + "</noscript></section>\n";
  return html;
}

std::string failures(const WorkPrecision &chart)
{
  HtmlTable table({"method", "events", "setting", "reason"});
  for (const WorkPoint &p : chart.points)
    if (!p.failure.empty())
      table.add({p.method, p.events ? "located" : "not located", setting_words(p), p.failure});
  return table.is_empty() ? "" : section("failures", "Failed runs", table.scrolled_html());
}

} // namespace

std::string work_precision_page(const WorkPrecision &chart)
{
  std::string signals;
  for (const std::string &signal : chart.signals)
    signals += (signals.empty() ? "" : ", ") + signal;
  std::string body =
      "<p>Error: root mean square of " + escape_xml(signals) + " over " + std::to_string(chart.n_samples) +
      " instants from " + text_of(chart.begin, 4) + " s to " + text_of(chart.end, 4) +
      " s, each signal scaled by its largest magnitude in the reference. Work: CPU time of the stepping thread." +
      (chart.peers.empty() ? std::string() : " Other solvers, on the same model: " + escape_xml(chart.peers) + ".") +
      "</p>\n" + note_box(chart.notes) + "<div id=\"chart\"></div>\n<script>const work = " + points_json(chart) +
      ";\n" + work_precision_script + "</script>\n";
  for (std::size_t m = 0; m < chart.models.size(); ++m)
    body += model_section(chart, int(m));
  return page_html({"Work and precision: " + chart.scene, chart.description, body + failures(chart),
                    "Gestell " + escape_xml(chart.version) +
                        ". Files: chart.csv (all runs), chart_settings.toml (recommended settings).",
                    work_precision_style});
}

} // namespace gestell::apps
