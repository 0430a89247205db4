#include "apps/study/report/study_report.h"

#include "apps/output/text/html.h"
#include "apps/study/report/choice_section.h"
#include "apps/study/report/outcome_sections.h"
#include "apps/study/report/scatter_matrix.h"
#include "apps/study/report/shown_axis.h"
#include "apps/study/report/surface_sections.h"
#include "apps/study/report/variable_charts.h"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace gestell::apps
{
namespace
{

std::string design_text(const Design &design)
{
  std::string text = design.type;
  if (design.alpha > 0.)
    text += ", alpha " + short_text(design.alpha, 5);
  if (design.centre_points > 0)
    text += ", " + count_text(design.centre_points, "centre point");
  return text;
}

std::string overview(const StudyFindings &findings)
{
  const StudyTable &table  = findings.table;
  const auto        failed = std::count_if(table.runs.begin(), table.runs.end(),
                                           [](const StudyRun &run) { return run.status == RunStatus::failed; });
  double            cpu    = 0.;
  for (const StudyRun &run : table.runs)
    cpu += run.cpu_s;
  HtmlTable variables({"variable", "scene key", "#from", "#to"});
  for (const StudyVariable &variable : table.variables)
  {
    const ShownAxis axis = shown_axis(variable);
    std::string     keys = variable.key;
    for (const std::string &key : variable.more_keys)
      keys += ", " + key;
    if (variable.words.empty())
      variables.add({variable.name, keys, axis.text_with_unit(variable.from), axis.text_with_unit(variable.to)});
    else
      variables.add({variable.name, keys, variable.words.front(), variable.words.back()});
  }
  const std::string sentence = count_text(table.n_runs(), "run") + " of " + findings.scene + " (" +
                               design_text(findings.design) + "): " + std::to_string(table.n_done()) + " done, " +
                               std::to_string(failed) + " failed; " + short_text(cpu, 3) + " s of CPU time.";
  return study_headline(findings, sentence).html() + folded("Variables", variables.html());
}

std::string scatter_section(const StudyFindings &findings, Pictures &pictures)
{
  const StudyTable usable = findings.table.usable();
  if (usable.n_runs() < 2 || usable.variables.empty())
    return "";
  std::vector<int> front;
  if (!findings.front_task.goals.empty())
  {
    Eigen::MatrixXd    goals(usable.n_runs(), static_cast<Eigen::Index>(findings.front_task.goals.size()));
    std::vector<Sense> senses;
    for (const Goal &goal : findings.front_task.goals)
    {
      goals.col(static_cast<Eigen::Index>(senses.size())) = usable.values.col(goal.output);
      senses.push_back(goal.sense);
    }
    front = nondominated(goals, senses);
  }
  pictures.emplace_back("scatter", scatter_matrix(usable, front));
  const std::size_t n = usable.variables.size() + usable.outputs.size();
  return section(
      "scatter", "Scatter plots of all runs",
      figure(pictures.back().second) + "<p class=\"soft\">Above the diagonal: linear correlation coefficients." +
          (n > most_scatter_columns ? " Of " + std::to_string(n) + " columns at most " +
                                          std::to_string(most_scatter_columns) + " are shown, without constant columns."
                                    : "") +
          "</p>\n",
      Shown::folded);
}

HtmlTable::Cell run_cell(const StudyTable &table, int run)
{
  HtmlTable::Cell cell(std::to_string(run + 1));
  cell.link = table.runs[run].link;
  return cell;
}

std::string status_text(const StudyRun &run)
{
  return run.status == RunStatus::done      ? "done"
         : run.status == RunStatus::waiting ? "pending"
                                            : "failed: " + run.message;
}

std::string runs_section(const StudyFindings &findings)
{
  const StudyTable        &table  = findings.table;
  std::vector<std::string> titles = {"run"};
  std::vector<ShownAxis>   inputs, outputs;
  for (const StudyVariable &variable : table.variables)
    titles.push_back("#" + escape_xml(inputs.emplace_back(shown_axis(variable)).head()));
  for (std::size_t j = 0; j < table.outputs.size(); ++j)
    titles.push_back(
        "#" + escape_xml(outputs
                             .emplace_back(shown_axis(table.outputs[j],
                                                      magnitude_of(table.values.col(static_cast<Eigen::Index>(j)))))
                             .head()));
  titles.insert(titles.end(), {"#CPU time [s]", "status"});

  HtmlTable     rows(titles);
  constexpr int most_rows_of_runs = 500; // some screens; runs.csv has all
  for (int run = 0; run < std::min(table.n_runs(), most_rows_of_runs); ++run)
  {
    std::vector<HtmlTable::Cell> row = {run_cell(table, run)};
    for (std::size_t j = 0; j < inputs.size(); ++j)
      row.push_back(table.variables[j].words.empty()
                        ? inputs[j].text(table.levels(run, static_cast<Eigen::Index>(j)), 5)
                        : table.variables[j].text(table.levels(run, static_cast<Eigen::Index>(j))));
    for (std::size_t j = 0; j < outputs.size(); ++j)
    {
      const double value = table.values(run, static_cast<Eigen::Index>(j));
      row.push_back(std::isfinite(value) ? outputs[j].text(value, 6) : "–");
    }
    row.push_back(short_text(table.runs[run].cpu_s, 3));
    row.push_back(peak(status_text(table.runs[run]), table.runs[run].status == RunStatus::failed));
    rows.add(row);
  }
  if (table.n_runs() > most_rows_of_runs)
    rows.add_note("The first " + std::to_string(most_rows_of_runs) + " of " + std::to_string(table.n_runs()) +
                  " runs; all are in runs.csv.");
  return section("runs", "Runs", rows.scrolled_html());
}

/// Links to the sections there are.
std::string study_contents(const std::string &body)
{
  std::string html = "<nav>";
  for (const auto &[id, name] : {std::pair("optimum", "Optimum"),
                                 {"choice", "Best run"},
                                 {"over", "Over a variable"},
                                 {"effects", "Effects"},
                                 {"front", "Pareto front"},
                                 {"surfaces", "Surfaces"},
                                 {"robust", "Scatter of the variables"},
                                 {"scatter", "Scatter plots of all runs"},
                                 {"runs", "Runs"}})
    if (body.find("<section id=\"" + std::string(id) + "\"") != std::string::npos)
      html += "<a href=\"#" + std::string(id) + "\">" + name + "</a>";
  return html + "</nav>\n";
}

void make_file_names(Pictures &pictures)
{
  for (auto &[name, svg] : pictures)
    for (char &c : name)
      if (!std::isalnum(static_cast<unsigned char>(c)))
        c = '_';
}

} // namespace

StudyReport make_study_report(const StudyFindings &findings)
{
  StudyReport       report;
  const std::string body = optimum_section(findings) + choice_section(findings, report.pictures) +
                           over_variable_section(findings, report.pictures) +
                           effects_section(findings, report.pictures) + front_section(findings, report.pictures) +
                           surfaces_section(findings, report.pictures) + robust_section(findings) +
                           scatter_section(findings, report.pictures) + runs_section(findings);
  make_file_names(report.pictures);
  report.html = page_html({findings.name, findings.description,
                           overview(findings) + note_box(findings.warnings, "Warnings") + study_contents(body) + body,
                           "Computed with gestell " + escape_xml(findings.version) +
                               ". Full-precision values: the .csv files next to this page."});
  return report;
}

} // namespace gestell::apps
