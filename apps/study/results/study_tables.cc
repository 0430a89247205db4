#include "apps/study/results/study_tables.h"

#include "fem/values/number_text.h"

#include <cmath>
#include <iomanip>
#include <sstream>

namespace gestell::apps
{
namespace
{

/// Nothing where there is no number.
std::string cell_of(double value)
{
  return std::isnan(value) ? "" : exact_text(value);
}

void add_row(std::string &text, const std::vector<std::string> &cells)
{
  for (std::size_t i = 0; i < cells.size(); ++i)
    text += (i ? "," : "") + cells[i];
  text += '\n';
}

std::string with_unit(double value, const std::string &unit)
{
  const DisplayUnit shown = display_unit(unit, std::abs(value));
  return short_text(value * shown.factor, 5) + (shown.unit.empty() ? "" : ' ' + shown.unit);
}

} // namespace

std::string surface_csv(const std::vector<ResponseSurface> &surfaces)
{
  std::string text = "output,term,coefficient,confidence\n";
  for (const ResponseSurface &surface : surfaces)
    for (Eigen::Index j = 0; j < surface.coefficients.size(); ++j)
      add_row(text, {surface.output.name, surface.term_name(int(j)), cell_of(surface.coefficients[j]),
                     cell_of(surface.confidence[j])});
  return text;
}

std::string fit_csv(const std::vector<ResponseSurface> &surfaces)
{
  std::string text = "output,runs,coefficients,R2,adjusted R2,predicted R2,standard error,lack of fit F,lack of fit "
                     "p,largest leverage\n";
  for (const ResponseSurface &surface : surfaces)
  {
    const FitQuality &fit = surface.quality;
    add_row(text, {surface.output.name, std::to_string(fit.n_runs), std::to_string(fit.n_coefficients), cell_of(fit.r2),
                   cell_of(fit.adjusted_r2), cell_of(fit.predicted_r2), cell_of(fit.standard_error),
                   cell_of(fit.lack_of_fit_F), cell_of(fit.lack_of_fit_p_value), cell_of(surface.leverage.maxCoeff())});
  }
  return text;
}

std::string effects_csv(const std::vector<ResponseSurface> &surfaces)
{
  std::string text = "output,effect,kind,value,confidence,share\n";
  for (const ResponseSurface &surface : surfaces)
    for (const Effect &effect : effects_of(surface))
      add_row(text, {surface.output.name, effect.name, kind_word(effect.kind), cell_of(effect.value),
                     cell_of(effect.confidence), cell_of(effect.share)});
  return text;
}

std::string pareto_csv(const std::vector<ParetoPoint> &front, const StudyTable &table)
{
  std::vector<std::string> head;
  for (const StudyVariable &variable : table.variables)
    head.push_back(variable.name);
  for (const StudyOutput &output : table.outputs)
    head.push_back(output.name);
  std::string text;
  add_row(text, head);
  for (const ParetoPoint &point : front)
  {
    std::vector<std::string> cells;
    for (Eigen::Index i = 0; i < point.coded.size(); ++i)
      cells.push_back(cell_of(table.variables[std::size_t(i)].physical(point.coded[i])));
    for (const double value : point.values)
      cells.push_back(cell_of(value));
    add_row(text, cells);
  }
  return text;
}

std::string robust_csv(const std::vector<RobustResult> &robust)
{
  std::string text = "output,on,draws,failed,nominal,mean,mean error,deviation,deviation error,min,max";
  if (!robust.empty() && !robust.front().figures.empty())
    for (const Quantile &quantile : robust.front().figures.front().quantiles)
      text += ',' + percent(quantile.share) + " below";
  text += '\n';
  for (const RobustResult &result : robust)
    for (const RobustFigures &figures : result.figures)
    {
      std::vector<std::string> cells{figures.output.name,
                                     result.source,
                                     std::to_string(result.draws),
                                     std::to_string(result.failed),
                                     cell_of(figures.nominal),
                                     cell_of(figures.mean),
                                     cell_of(figures.mean_error),
                                     cell_of(figures.deviation),
                                     cell_of(figures.deviation_error),
                                     cell_of(figures.min),
                                     cell_of(figures.max)};
      for (const Quantile &quantile : figures.quantiles)
        cells.push_back(cell_of(quantile.value));
      add_row(text, cells);
    }
  return text;
}

namespace
{

void tell_surfaces(const StudyFindings &findings, std::ostream &text)
{
  for (const ResponseSurface &surface : findings.surfaces)
  {
    const FitQuality &fit = surface.quality;
    text << "surface of " << surface.output.name << ": R2 " << short_text(fit.r2, 5) << ", adjusted "
         << short_text(fit.adjusted_r2, 5) << ", predicted " << short_text(fit.predicted_r2, 5) << ", standard error "
         << with_unit(fit.standard_error, surface.output.unit) << '\n';
  }
}

void tell_optimum(const StudyFindings &findings, std::ostream &text)
{
  const StudyOptimum &optimum = *findings.optimum;
  const StudyTable   &table   = findings.table;
  text << "optimum" << (optimum.found.feasible ? "" : ", which breaks a limit") << " on "
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
         << with_unit(optimum.found.values[at], table.outputs[i].unit);
    if (optimum.verified)
      text << ", by a run " << with_unit((*optimum.verified)[at], table.outputs[i].unit);
    if (optimum.nominal)
      text << "; in the middle of all ranges " << with_unit((*optimum.nominal)[at], table.outputs[i].unit);
    text << '\n';
  }
}

} // namespace

std::string findings_text(const StudyFindings &findings)
{
  std::ostringstream text;
  tell_surfaces(findings, text);
  if (findings.optimum)
    tell_optimum(findings, text);
  if (!findings.front.empty())
    text << "front of the goals: " << findings.front.size() << " points in pareto.csv\n";
  for (const RobustResult &result : findings.robust)
    for (const RobustFigures &figures : result.figures)
      text << "scatter: " << figures.output.name << " " << with_unit(figures.mean, figures.output.unit)
           << ", standard deviation " << with_unit(figures.deviation, figures.output.unit) << '\n';
  return text.str();
}

} // namespace gestell::apps
