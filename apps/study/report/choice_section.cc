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

/// Words of a variable that parts families, as the place of its colour or line.
int word_at(const StudyTable &table, const RowChoiceTask &task, int row, std::size_t by)
{
  return by < task.by.size() ? int(std::lround(table.levels(row, task.by[by]))) : 0;
}

/// Colour by the first word, marker and line by the last, so that of two kinds no curve looks like another.  Filled
/// markers keep all limits.
Curve curve_of(const StudyTable &table, const RowChoice &choice, const std::vector<int> &family, int output)
{
  static constexpr Marker    markers[] = {Marker::disc, Marker::square, Marker::triangle, Marker::diamond};
  static constexpr LineStyle lines[] = {LineStyle::full, LineStyle::dashed, LineStyle::dotted, LineStyle::dash_dotted};

  const ShownAxis x = axis_of(table, choice.task.over), y = axis_of(table, output);
  const int       first = word_at(table, choice.task, family.front(), 0),
            second      = word_at(table, choice.task, family.front(), 1);
  Curve curve;
  curve.name   = family_of(table, choice.task, family.front());
  curve.colour = first;
  curve.marker = markers[(choice.task.by.size() > 1 ? second : first) % 4];
  curve.line   = lines[second % 4];
  for (const int row : family)
    if (table.runs[std::size_t(row)].status == RunStatus::done)
    {
      curve.add(x.shown(table.values(row, choice.task.over)), y.shown(table.values(row, output)));
      curve.notes.push_back({"run " + std::to_string(row + 1) + ", " + y.text_with_unit(table.values(row, output)),
                             !keeps_limits(choice, row)});
    }
  return curve;
}

/// The best run, on top of the others.
Curve best_curve(const StudyTable &table, const RowChoice &choice, int output)
{
  const ShownAxis   x = axis_of(table, choice.task.over), y = axis_of(table, output);
  const std::string family = family_of(table, choice.task, choice.best);
  Curve best = rings("best: run " + std::to_string(choice.best + 1) + (family.empty() ? "" : ", ") + family, 1);
  best.add(x.shown(table.values(choice.best, choice.task.over)), y.shown(table.values(choice.best, output)));
  return best;
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

/// A bar along the abscissa, and its ends through the chart.
void mark_window(const StudyTable &table, const RowChoice &choice, Chart &chart)
{
  constexpr double bar_height = 0.025; ///< of the chart
  if (choice.window.size() < 2)
    return;
  const ShownAxis x      = axis_of(table, choice.task.over);
  const double    from   = x.shown(table.values(choice.window.front(), choice.task.over));
  const double    to     = x.shown(table.values(choice.window.back(), choice.task.over));
  const int       colour = 6;
  Panel          &panel  = chart.panels.front();
  for (const double end : {from, to})
  {
    Curve edge{"", {}, {}, colour, LineStyle::dotted, Marker::none};
    edge.add(end, chart.y.begin);
    edge.add(end, chart.y.end);
    panel.curves.push_back(edge);
  }
  panel.curves.push_back(
      tile_name("feasible range, " + short_text(from, 3) + " to " + short_text(to, 3) + ' ' + x.unit, colour));
  panel.tiles.push_back({from, to, chart.y.begin, chart.y.begin + bar_height * (chart.y.end - chart.y.begin), colour,
                         family_of(table, choice.task, choice.best) + ": all limits satisfied"});
}

std::string chart_of(const StudyTable &table, const RowChoice &choice, int output)
{
  const ShownAxis y = axis_of(table, output);
  Chart           chart;
  chart.title            = y.head() + " over " + axis_of(table, choice.task.over).head();
  chart.note             = choice.best < 0 ? "no run satisfies all limits" : "filled: all limits satisfied";
  chart.x.label          = axis_of(table, choice.task.over).head();
  const auto [low, high] = ends_of(table, output, y);
  chart.y                = fitted(ChartAxis{y.head()}, low, high, 0.05);
  chart.height           = 320.;
  for (const std::vector<int> &family : families_of(table, choice.task))
    chart.panels.front().curves.push_back(curve_of(table, choice, family, output));
  if (choice.best >= 0)
    chart.panels.front().curves.push_back(best_curve(table, choice, output));
  mark_window(table, choice, chart);
  for (const Limit &limit : choice.task.limits)
    for (const double bound : {limit.least, limit.most})
      if (limit.output == output && std::isfinite(bound))
        chart.levels.push_back({y.shown(bound), "limit"});
  return chart_svg(chart);
}

/// "run 94 is", "runs 94, 96 are"
std::string ties_text(const std::vector<int> &rows)
{
  std::string numbers;
  for (const int row : rows)
    numbers += (numbers.empty() ? "" : ", ") + std::to_string(row + 1);
  return rows.size() == 1 ? "run " + numbers + " is" : "runs " + numbers + " are";
}

/// "0.5 to 2.04"
std::string window_text(const StudyTable &table, const RowChoiceTask &task, const FamilyChoice &family)
{
  const ShownAxis x = axis_of(table, task.over);
  return x.text(table.values(family.window.front(), task.over), 3) + " to " +
         x.text(table.values(family.window.back(), task.over), 3);
}

/// The best of each family, and where it keeps the limits.
std::string families_table(const StudyTable &table, const RowChoice &choice)
{
  if (choice.families.size() < 2)
    return "";
  const bool               over = choice.task.over >= 0;
  std::vector<std::string> titles{"family", "#best run"};
  for (const int output : outputs_of(choice.task))
    titles.push_back("#" + escape_xml(axis_of(table, output).head()));
  if (over)
    titles.push_back("#limits satisfied, " + escape_xml(axis_of(table, choice.task.over).head()));
  HtmlTable families(titles);
  for (const FamilyChoice &family : choice.families)
  {
    const bool                   any = family.best >= 0;
    std::vector<HtmlTable::Cell> row{family_of(table, choice.task, family.rows.front()),
                                     any ? std::to_string(family.best + 1) : "none"};
    for (const int output : outputs_of(choice.task))
      row.push_back(any ? axis_of(table, output).text(table.values(family.best, output), 4) : "–");
    if (over)
      row.push_back(any ? window_text(table, choice.task, family) : "–");
    families.add(row);
  }
  return families.scrolled_html();
}

} // namespace

std::string choice_text(const StudyFindings &findings)
{
  const RowChoice  &choice = *findings.choice;
  const StudyTable &table  = findings.table;
  if (choice.best < 0)
    return "no run satisfies all limits";
  std::string text = "the best of " + count_text(choice.kept.size(), "run") + " that satisfy all limits is run " +
                     std::to_string(choice.best + 1) + ": ";
  for (std::size_t i = 0; i < table.variables.size(); ++i)
    text += (i ? ", " : "") + table.variables[i].name + " = " +
            table.variables[i].text(table.levels(choice.best, Eigen::Index(i)));
  for (const int output : outputs_of(choice.task))
    text += "; " + table.outputs[std::size_t(output)].name + " " +
            axis_of(table, output).text_with_unit(table.values(choice.best, output));
  if (!choice.ties.empty())
    text += "; " + ties_text(choice.ties) + " equally good";
  if (choice.window.size() < 2)
    return text;
  const ShownAxis x = axis_of(table, choice.task.over);
  return text + "; runs of its family satisfy the limits from " +
         x.text_with_unit(table.values(choice.window.front(), choice.task.over)) + " to " +
         x.text_with_unit(table.values(choice.window.back(), choice.task.over)) + " of " + x.name;
}

std::string choice_section(const StudyFindings &findings, Pictures &pictures)
{
  if (!findings.choice)
    return "";
  std::string body =
      "<p>" + escape_xml(choice_text(findings)) + ".</p>\n" + families_table(findings.table, *findings.choice);
  if (findings.choice->task.over >= 0)
    for (const int output : outputs_of(findings.choice->task))
    {
      pictures.emplace_back("choice_" + findings.table.outputs[std::size_t(output)].name,
                            chart_of(findings.table, *findings.choice, output));
      body += figure(pictures.back().second);
    }
  return section("choice", "Best run", body);
}

} // namespace gestell::apps
