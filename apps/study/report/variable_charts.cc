#include "apps/study/report/variable_charts.h"

#include "apps/output/charts/chart.h"
#include "apps/study/report/shown_axis.h"

#include <algorithm>
#include <map>

namespace gestell::apps
{
namespace
{

/// "wall = 15 mm, layers = 2" of a run, without one of the variables.
std::string settings_of(const StudyTable &table, int run, int without = -1)
{
  std::string text;
  for (std::size_t j = 0; j < table.variables.size(); ++j)
    if (int(j) != without)
      text += (text.empty() ? "" : ", ") + table.variables[j].name + " = " +
              table.variables[j].text(table.levels(run, Eigen::Index(j)));
  return text;
}

/// The first variable that takes different numbers; -1: there is none.
int followed_variable(const StudyTable &table)
{
  for (std::size_t j = 0; j < table.variables.size(); ++j)
    if (const auto levels = table.levels.col(Eigen::Index(j));
        table.variables[j].words.empty() && levels.size() > 0 && levels.maxCoeff() > levels.minCoeff())
      return int(j);
  return -1;
}

/// Runs with values of the other variables in common, in the order of the one that is followed.
std::map<std::string, std::vector<int>> families_over(const StudyTable &table, int variable,
                                                      const std::vector<int> &runs)
{
  std::map<std::string, std::vector<int>> families;
  for (const int run : runs)
    families[settings_of(table, run, variable)].push_back(run);
  constexpr std::size_t most_families = 6; // curves of a chart with names
  if (families.size() > most_families)
    families = {{"", runs}};
  for (auto &[name, own] : families)
    std::stable_sort(own.begin(), own.end(),
                     [&](int a, int b) { return table.levels(a, variable) < table.levels(b, variable); });
  return families;
}

Chart chart_over(const StudyTable &table, int variable, int output)
{
  const ShownAxis        x    = shown_axis(table.variables[std::size_t(variable)]);
  const ShownAxis        y    = shown_axis(table.outputs[std::size_t(output)], magnitude_of(table.values.col(output)));
  const std::vector<int> runs = table.runs_with(output);
  Chart                  chart;
  chart.title   = y.head() + " over " + x.head();
  chart.x.label = x.head();
  chart.height  = 300.;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const auto &[name, own] : families_over(table, variable, runs))
  {
    Curve curve;
    curve.name   = name;
    curve.marker = Marker::disc;
    if (own.size() == runs.size() && table.variables.size() > 1)
      curve.line = LineStyle::none;        // others vary along it
    constexpr std::size_t most_dots = 400; // of a curve: more cover each other
    const std::size_t     stride    = own.size() / most_dots + 1;
    for (std::size_t i = 0; i < own.size(); i += stride)
    {
      const int run = own[i];
      curve.add(x.shown(table.levels(run, variable)), y.shown(table.values(run, output)));
      curve.notes.push_back({"run " + std::to_string(run + 1) + ": " + settings_of(table, run)});
      low  = std::min(low, curve.y.back());
      high = std::max(high, curve.y.back());
    }
    curve.colour = int(chart.panels.front().curves.size());
    chart.panels.front().curves.push_back(curve);
  }
  chart.y = fitted(ChartAxis{y.head()}, low, high, 0.05);
  return chart;
}

} // namespace

Headline study_headline(const StudyFindings &findings, const std::string &sentence)
{
  Headline              headline{sentence};
  const StudyTable     &table      = findings.table;
  constexpr std::size_t most_shown = 3; // outputs: a row of numbers
  for (std::size_t j = 0; j < std::min(table.outputs.size(), most_shown); ++j)
  {
    const auto             at   = Eigen::Index(j);
    const std::vector<int> runs = table.runs_with(int(j));
    if (runs.empty())
      continue;
    const auto [low, high] = std::minmax_element(
        runs.begin(), runs.end(), [&](int a, int b) { return table.values(a, at) < table.values(b, at); });
    const ShownAxis axis = shown_axis(table.outputs[j], magnitude_of(table.values.col(at)));
    const bool      same = table.values(*low, at) == table.values(*high, at);
    headline.numbers.push_back(
        {same ? axis.text_with_unit(table.values(*low, at))
              : axis.text(table.values(*low, at)) + " to " + axis.text_with_unit(table.values(*high, at)),
         axis.name + (same ? ": equal in all runs" : "; minimum at " + settings_of(table, *low))});
    if (findings.optimum)
    {
      const StudyOptimum &optimum = *findings.optimum;
      headline.numbers.push_back(
          {axis.text_with_unit(optimum.verified ? (*optimum.verified)[at] : optimum.found.values[at]),
           axis.name + " at the optimum" + (optimum.verified ? " (run)" : "")});
    }
  }
  return headline;
}

std::string over_variable_section(const StudyFindings &findings, Pictures &pictures)
{
  const int                variable = followed_variable(findings.table);
  std::vector<std::string> figures;
  for (std::size_t j = 0; j < findings.table.outputs.size() && variable >= 0; ++j)
    if (findings.table.runs_with(int(j)).size() > 1)
    {
      pictures.emplace_back("over_" + findings.table.outputs[j].name,
                            chart_svg(chart_over(findings.table, variable, int(j))));
      figures.push_back(figure(pictures.back().second));
    }
  return figures.empty()
             ? ""
             : section("over", "Outputs over " + escape_xml(findings.table.variables[std::size_t(variable)].name),
                       first_figures(figures));
}

} // namespace gestell::apps
