#include "apps/study/results/findings_text.h"

#include "apps/output/text/change_text.h"
#include "apps/study/report/choice_section.h"
#include "fem/values/number_text.h"

#include <cmath>
#include <iomanip>
#include <sstream>

namespace gestell::apps
{
namespace
{

void tell_surfaces(const StudyFindings &findings, std::ostream &text)
{
  for (const ResponseSurface &surface : findings.surfaces)
  {
    const FitQuality &fit = surface.quality;
    if (!surface.changes())
    {
      text << "surface of " << surface.output.name << ": it does not change over the runs\n";
      continue;
    }
    text << "surface of " << surface.output.name << ": R2 " << short_text(fit.r2, 5) << ", adjusted "
         << short_text(fit.adjusted_r2, 5) << ", predicted " << short_text(fit.predicted_r2, 5) << ", standard error "
         << quantity_text(fit.standard_error, surface.output.unit, 5) << '\n';
  }
}

void tell_optimum(const StudyFindings &findings, std::ostream &text)
{
  const StudyOptimum &optimum = *findings.optimum;
  const StudyTable   &table   = findings.table;
  text << "optimum" << (optimum.found.feasible ? "" : ", which violates a limit") << " on "
       << (optimum.source == "surface" ? "the surface" : count_text(std::size_t(optimum.found.evaluations), "run"))
       << ":\n";
  for (std::size_t i = 0; i < table.variables.size(); ++i)
    text << "  " << table.variables[i].name << " = "
         << short_text(table.variables[i].physical(optimum.found.coded[Eigen::Index(i)]), 6)
         << (table.variables[i].unit.empty() ? "" : ' ' + table.variables[i].unit) << '\n';
  for (std::size_t i = 0; i < table.outputs.size(); ++i)
  {
    const auto at = Eigen::Index(i);
    text << "  " << std::left << std::setw(12) << table.outputs[i].name << ' '
         << quantity_text(optimum.found.values[at], table.outputs[i].unit, 5);
    if (optimum.verified)
      text << ", run " << quantity_text((*optimum.verified)[at], table.outputs[i].unit, 5);
    if (optimum.nominal)
      text << "; at the midpoints of all ranges " << quantity_text((*optimum.nominal)[at], table.outputs[i].unit, 5);
    text << '\n';
  }
}

} // namespace

std::string findings_text(const StudyFindings &findings)
{
  std::ostringstream text;
  tell_surfaces(findings, text);
  if (findings.choice)
    text << choice_text(findings) << '\n';
  if (findings.optimum)
    tell_optimum(findings, text);
  if (!findings.front.empty())
    text << "Pareto front of the goals: " << findings.front.size() << " points in front.csv\n";
  for (const RobustResult &result : findings.robust)
    for (const RobustFigures &figures : result.figures)
      text << "scatter: " << figures.output.name << " " << quantity_text(figures.mean, figures.output.unit, 5)
           << ", standard deviation " << quantity_text(figures.deviation, figures.output.unit, 5) << '\n';
  return text.str();
}

} // namespace gestell::apps
