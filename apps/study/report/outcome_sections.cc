#include "apps/study/report/outcome_sections.h"

#include "apps/output/text/change_text.h"
#include "apps/output/text/html.h"
#include "apps/study/report/shown_axis.h"
#include "apps/study/report/study_charts.h"

#include <cmath>

namespace gestell::apps
{
namespace
{

std::string signed_percent(double share)
{
  if (std::abs(share) < 1e-9) // rounding
    return "0 %";
  return !std::isfinite(share) ? "–" : (share > 0. ? "+" : "") + short_text(100. * share, 3) + " %";
}

/// "minimise 0.4 F_P_max / 1.06 MN + 0.2 weight / 257 kN"
std::string task_text(const OptimumTask &task, const StudyTable &table)
{
  std::string text;
  for (const Goal &goal : task.goals)
  {
    const StudyOutput &output = table.outputs[goal.output];
    text += text.empty() ? (goal.sense == Sense::minimise ? "minimise " : "maximise ")
                         : (goal.sense == task.goals.front().sense ? " + " : " - ");
    text += (goal.weight != 1. ? short_text(goal.weight) + " " : "") + output.name;
    if (goal.scale != 1.)
      text += " / " + shown_axis(output, goal.scale).text_with_unit(goal.scale);
  }
  return text;
}

std::string limits_text(const OptimumTask &task, const StudyTable &table)
{
  std::string text;
  for (const Limit &limit : task.limits)
  {
    const StudyOutput &output = table.outputs[limit.output];
    const auto         shown  = [&](double bound) { return shown_axis(output, std::abs(bound)).text_with_unit(bound); };
    text += text.empty() ? "" : ", ";
    text += (std::isfinite(limit.least) ? shown(limit.least) + " ≤ " : "") + output.name +
            (std::isfinite(limit.most) ? " ≤ " + shown(limit.most) : "");
  }
  return text;
}

/// Where a wall of the box holds the optimum.
std::string wall_text(const StudyOptimum &optimum, Eigen::Index j)
{
  const double     xi        = optimum.found.coded(j);
  constexpr double at_a_wall = 1e-6; // coded: searches end there but for their tolerance
  if (xi - optimum.task.low(j) < at_a_wall)
    return "at the lower end of its range";
  return optimum.task.high(j) - xi < at_a_wall ? "at the upper end of its range" : "";
}

std::string variables_table(const StudyFindings &findings)
{
  HtmlTable table({"variable", "#optimum", "#coded", "#from", "#to", "remark"});
  for (std::size_t j = 0; j < findings.table.variables.size(); ++j)
  {
    const StudyVariable &variable = findings.table.variables[j];
    const ShownAxis      axis     = shown_axis(variable);
    const double         xi       = findings.optimum->found.coded(static_cast<Eigen::Index>(j));
    table.add({variable.name, peak(axis.text_with_unit(variable.physical(xi))), short_text(xi),
               axis.text(variable.from), axis.text(variable.to),
               wall_text(*findings.optimum, static_cast<Eigen::Index>(j))});
  }
  return table.html();
}

std::string outputs_table(const StudyFindings &findings)
{
  const StudyOptimum &optimum = *findings.optimum;
  const bool          surface = optimum.source == "surface";
  HtmlTable table({"output", "#at the midpoint", surface ? "#surface" : "#optimum", "#run", "#error of the surface",
                   "#magnitude relative to midpoint"});
  for (std::size_t i = 0; i < findings.table.outputs.size(); ++i)
  {
    const auto   at    = static_cast<Eigen::Index>(i);
    const double found = optimum.found.values(at), run = optimum.verified ? (*optimum.verified)(at) : std::nan("");
    const double before  = optimum.nominal ? (*optimum.nominal)(at) : std::nan(""),
                 after   = std::isnan(run) ? found : run;
    const ShownAxis axis = shown_axis(findings.table.outputs[i], std::abs(found));
    const auto      text = [&](double x) { return std::isfinite(x) ? axis.text(x, 5) : std::string("–"); };
    table.add({axis.head(), text(before), text(found), peak(text(run)), signed_percent((found - run) / std::abs(run)),
               change_text(before, after)});
  }
  return table.html();
}

std::string searches_table(const StudyFindings &findings)
{
  std::vector<std::string> titles = {"#search", "#objective", "limits satisfied", "#evaluations", "termination"};
  for (const StudyVariable &variable : findings.table.variables)
    titles.push_back("#" + escape_xml(variable.name) + ", coded");
  HtmlTable table(titles);
  int       number = 0;
  for (const SearchTrack &search : findings.optimum->found.searches)
  {
    std::vector<HtmlTable::Cell> row = {std::to_string(++number), short_text(search.objective, 7),
                                        peak(search.feasible ? "yes" : "no", !search.feasible),
                                        std::to_string(search.evaluations), search.reason};
    for (const double xi : search.to)
      row.push_back(short_text(xi));
    table.add(row);
  }
  return folded("Searches from several starts", table.scrolled_html());
}

std::string optimum_words(const StudyFindings &findings)
{
  const StudyOptimum &optimum = *findings.optimum;
  const std::string   limits  = limits_text(optimum.task, findings.table);
  std::string text = "To " + task_text(optimum.task, findings.table) + (limits.empty() ? "" : ", with " + limits) +
                     ", on " + (optimum.source == "surface" ? "the response surfaces" : "runs") +
                     " within the ranges: " + count_text(optimum.found.evaluations, "evaluation") +
                     (optimum.found.failed > 0 ? ", " + std::to_string(optimum.found.failed) + " of them failed" : "") +
                     ".";
  std::string html =
      "<p>" + escape_xml(text) +
      (optimum.link.empty() ? "" : " <a href=\"" + escape_xml(optimum.link) + "\">Run at this point</a>.") + "</p>\n";
  if (!optimum.found.feasible)
    html += note_box({"No point satisfies all limits; this one violates them least."});
  if (optimum.source == "surface" && !optimum.verified)
    html += note_box({"No run has verified this point."});
  return html;
}

std::string interval_text(const ShownAxis &axis, const Quantile &quantile)
{
  const auto side = [&](double x) { return std::isfinite(x) ? axis.text(x) : std::string("?"); };
  return axis.text(quantile.value) + " (" + side(quantile.low) + " … " + side(quantile.high) + ")";
}

std::string with_error(const ShownAxis &axis, double value, double error)
{
  return axis.text(value, 5) + " ± " + axis.text(error, 2);
}

std::string robust_table(const RobustResult &result)
{
  HtmlTable table(
      {"output", "#without scatter", "#mean", "#standard deviation", "#1 %", "#5 %", "#50 %", "#95 %", "#99 %"});
  for (const RobustFigures &figures : result.figures)
  {
    const ShownAxis axis = shown_axis(figures.output, std::max(std::abs(figures.min), std::abs(figures.max)));
    std::vector<HtmlTable::Cell> row = {axis.head(), std::isnan(figures.nominal) ? "–" : axis.text(figures.nominal, 5),
                                        with_error(axis, figures.mean, figures.mean_error),
                                        with_error(axis, figures.deviation, figures.deviation_error)};
    for (const Quantile &quantile : figures.quantiles)
      row.push_back(interval_text(axis, quantile));
    table.add(row);
  }
  return table.html();
}

std::string robust_words(const RobustResult &result)
{
  std::string text = count_text(result.draws, "draw") + ", seed " + std::to_string(result.seed);
  if (result.failed > 0)
    text += ", " + std::to_string(result.failed) + " failed and are omitted";
  text += "; limits are satisfied in " + percent(result.kept) + " ± " + percent(result.kept_error, 2) + ".";
  if (result.source == "surface" && result.outside > 0.)
    text += " In " + percent(result.outside) +
            " of them a variable is outside the range of the study, where the surface extrapolates.";
  return "<p>" + text + "</p>\n";
}

} // namespace

std::string optimum_section(const StudyFindings &findings)
{
  if (!findings.optimum)
    return "";
  return section("optimum", "Optimum",
                 optimum_words(findings) + variables_table(findings) + outputs_table(findings) +
                     searches_table(findings));
}

std::string front_section(const StudyFindings &findings, Pictures &pictures)
{
  const int   n = static_cast<int>(findings.front_task.goals.size());
  std::string html;
  for (int a = 0; a < n; ++a)
    for (int b = a + 1; b < n; ++b)
    {
      const std::string name = n == 2 ? "front" : "front_" + std::to_string(a + 1) + "_" + std::to_string(b + 1);
      pictures.emplace_back(name, pareto_chart(findings, a, b));
      html += figure(pictures.back().second);
    }
  if (html.empty())
    return "";
  return section("front", "Pareto front",
                 html +
                     "<p class=\"soft\">For each run on the front, no other run is at least as good in all goals and "
                     "better in one." +
                     (findings.front.empty()
                          ? ""
                          : " The front computed on the response surfaces is in front.csv; it contains their errors.") +
                     "</p>\n");
}

std::string robust_section(const StudyFindings &findings)
{
  std::string html;
  for (const RobustResult &result : findings.robust)
    html += std::string("<h3>") + (result.source == "surface" ? "From the surfaces" : "From runs") + "</h3>\n" +
            robust_words(result) + robust_table(result);
  if (html.empty())
    return "";
  return section(
      "robust", "Effect of scatter of the variables",
      html + "<p class=\"soft\">±: standard error due to the number of draws. Quantiles are given with their 95 % "
             "confidence interval.</p>\n");
}

} // namespace gestell::apps
