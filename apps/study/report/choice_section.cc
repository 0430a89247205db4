#include "apps/study/report/choice_section.h"

#include "apps/output/charts/chart.h"
#include "apps/output/text/html.h"
#include "apps/study/report/shown_axis.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{
namespace
{

ShownAxis axis_of(const StudyTable &table, int output)
{
  const Eigen::VectorXd values = table.values.col(output);
  return shown_axis(table.outputs[std::size_t(output)], magnitude_of(values));
}

/// Outputs that goals and limits are about, each once.
std::vector<int> outputs_of(const RowChoiceTask &task)
{
  std::vector<int> outputs;
  const auto       add = [&](int output)
  {
    if (std::find(outputs.begin(), outputs.end(), output) == outputs.end())
      outputs.push_back(output);
  };
  for (const Goal &goal : task.goals)
    add(goal.output);
  for (const Limit &limit : task.limits)
    add(limit.output);
  return outputs;
}

bool keeps_limits(const RowChoice &choice, int row)
{
  return std::find(choice.kept.begin(), choice.kept.end(), row) != choice.kept.end();
}

/// Filled markers keep all limits.
Curve curve_of(const StudyTable &table, const RowChoice &choice, const std::vector<int> &family, int output)
{
  const ShownAxis x = axis_of(table, choice.task.over), y = axis_of(table, output);
  Curve           curve;
  curve.name   = family_of(table, choice.task, family.front());
  curve.marker = Marker::disc;
  for (const int row : family)
    if (table.runs[std::size_t(row)].status == RunStatus::done)
    {
      curve.add(x.shown(table.values(row, choice.task.over)), y.shown(table.values(row, output)));
      curve.notes.push_back({"run " + std::to_string(row + 1) + ", " + y.text_with_unit(table.values(row, output)),
                             !keeps_limits(choice, row)});
    }
  return curve;
}

/// Ends of a column's values, in the unit shown.
std::pair<double, double> ends_of(const StudyTable &table, int output, const ShownAxis &axis)
{
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (int row = 0; row < table.n_runs(); ++row)
    if (std::isfinite(table.values(row, output)))
    {
      low  = std::min(low, axis.shown(table.values(row, output)));
      high = std::max(high, axis.shown(table.values(row, output)));
    }
  return {low, high};
}

/// A bar along the abscissa.
void mark_window(const StudyTable &table, const RowChoice &choice, Chart &chart)
{
  constexpr double bar_height = 0.025; ///< of the chart
  if (choice.window.size() < 2)
    return;
  const ShownAxis x    = axis_of(table, choice.task.over);
  const double    from = x.shown(table.values(choice.window.front(), choice.task.over));
  const double    to   = x.shown(table.values(choice.window.back(), choice.task.over));
  chart.panels.front().tiles.push_back({from, to, chart.y.begin,
                                        chart.y.begin + bar_height * (chart.y.end - chart.y.begin), 2,
                                        family_of(table, choice.task, choice.best) + ": all limits are kept"});
}

std::string chart_of(const StudyTable &table, const RowChoice &choice, int output)
{
  const ShownAxis y = axis_of(table, output);
  Chart           chart;
  chart.title = y.head() + " over " + axis_of(table, choice.task.over).head();
  chart.note  = "filled: all limits are kept; bar: the window about the best run, run " +
               (choice.best < 0 ? std::string("none") : std::to_string(choice.best + 1));
  chart.x.label          = axis_of(table, choice.task.over).head();
  const auto [low, high] = ends_of(table, output, y);
  chart.y                = fitted(ChartAxis{y.head()}, low, high, 0.05);
  chart.height           = 320.;
  mark_window(table, choice, chart);
  for (const std::vector<int> &family : families_of(table, choice.task))
    chart.panels.front().add(curve_of(table, choice, family, output));
  for (const Limit &limit : choice.task.limits)
    for (const double bound : {limit.least, limit.most})
      if (limit.output == output && std::isfinite(bound))
        chart.levels.push_back({y.shown(bound), "limit"});
  return chart_svg(chart);
}

} // namespace

std::string choice_text(const StudyFindings &findings)
{
  const RowChoice  &choice = *findings.choice;
  const StudyTable &table  = findings.table;
  if (choice.best < 0)
    return "no run keeps all limits";
  std::string text = "the best of " + count_text(choice.kept.size(), "run") + " that keep all limits is run " +
                     std::to_string(choice.best + 1) + ": ";
  for (std::size_t i = 0; i < table.variables.size(); ++i)
    text += (i ? ", " : "") + table.variables[i].name + " = " +
            table.variables[i].text(table.levels(choice.best, Eigen::Index(i)));
  for (const int output : outputs_of(choice.task))
    text += "; " + table.outputs[std::size_t(output)].name + " " +
            axis_of(table, output).text_with_unit(table.values(choice.best, output));
  if (choice.window.size() < 2)
    return text;
  const ShownAxis x = axis_of(table, choice.task.over);
  return text + "; runs of its family keep the limits from " +
         x.text_with_unit(table.values(choice.window.front(), choice.task.over)) + " to " +
         x.text_with_unit(table.values(choice.window.back(), choice.task.over)) + " of " + x.name;
}

std::string choice_section(const StudyFindings &findings, Pictures &pictures)
{
  if (!findings.choice)
    return "";
  std::string body = "<p>" + escape_xml(choice_text(findings)) + ".</p>\n";
  if (findings.choice->task.over >= 0)
    for (const int output : outputs_of(findings.choice->task))
    {
      pictures.emplace_back("choice_" + findings.table.outputs[std::size_t(output)].name,
                            chart_of(findings.table, *findings.choice, output));
      body += figure(pictures.back().second);
    }
  return section("choice", "The best run", body);
}

} // namespace gestell::apps
