#include "apps/study/report/study_tables.h"

#include "apps/output/text/csv.h"
#include "fem/values/number_text.h"

#include <cmath>

namespace gestell::apps
{
namespace
{

/// ",x"; nothing behind the comma for what is not known.
std::string csv_number(double x)
{
  return std::isnan(x) ? "," : "," + exact_text(x);
}

} // namespace

std::string surface_csv(const std::vector<ResponseSurface> &surfaces)
{
  std::string csv = "output,term,coefficient,confidence\n";
  for (const ResponseSurface &surface : surfaces)
    for (int j = 0; j < surface.coefficients.size(); ++j)
      csv += csv_field(surface.output.name) + "," + csv_field(surface.term_name(j)) +
             csv_number(surface.coefficients(j)) + csv_number(surface.confidence(j)) + "\n";
  return csv;
}

std::string surface_quality_csv(const std::vector<ResponseSurface> &surfaces)
{
  std::string csv =
      "output,runs,coefficients,R2,adjusted R2,predicted R2,standard error,PRESS,lack of fit,degrees of freedom,"
      "pure error,degrees of freedom,F,p\n";
  for (const ResponseSurface &surface : surfaces)
  {
    const FitQuality &q = surface.quality;
    csv += csv_field(surface.output.head()) + "," + std::to_string(q.n_runs) + "," + std::to_string(q.n_coefficients);
    for (const double x : {q.r2, q.adjusted_r2, q.predicted_r2, q.standard_error, q.press, q.lack_of_fit,
                           static_cast<double>(q.lack_of_fit_dof), q.pure_error, static_cast<double>(q.pure_error_dof),
                           q.lack_of_fit_F, q.lack_of_fit_p_value})
      csv += csv_number(x);
    csv += "\n";
  }
  return csv;
}

std::string effects_csv(const std::vector<ResponseSurface> &surfaces)
{
  std::string csv = "output,effect,kind,value,confidence,share of variance\n";
  for (const ResponseSurface &surface : surfaces)
    for (const Effect &effect : effects_of(surface))
      csv += csv_field(surface.output.name) + "," + csv_field(effect.name) + "," + kind_word(effect.kind) +
             csv_number(effect.value) + csv_number(effect.confidence) + csv_number(effect.share) + "\n";
  return csv;
}

std::string front_csv(const StudyFindings &findings)
{
  std::string csv = "point";
  for (const StudyVariable &variable : findings.table.variables)
    csv += "," + csv_field(variable.head());
  for (const StudyOutput &output : findings.table.outputs)
    csv += "," + csv_field(output.head());
  csv += "\n";
  int number = 0;
  for (const ParetoPoint &point : findings.front)
  {
    csv += std::to_string(++number);
    for (std::size_t j = 0; j < findings.table.variables.size(); ++j)
      csv += csv_number(findings.table.variables[j].physical(point.coded(static_cast<Eigen::Index>(j))));
    for (const double value : point.values)
      csv += csv_number(value);
    csv += "\n";
  }
  return csv;
}

std::string robust_csv(const std::vector<RobustResult> &results)
{
  std::string csv =
      "source,output,draws,failed,nominal,mean,error of the mean,standard deviation,error of the deviation,min,max";
  for (const char *share : {"1 %", "5 %", "50 %", "95 %", "99 %"})
    csv += std::string(",") + share + "," + share + " low," + share + " high";
  csv += "\n";
  for (const RobustResult &result : results)
    for (const RobustFigures &f : result.figures)
    {
      csv += result.source + "," + csv_field(f.output.head()) + "," + std::to_string(result.draws) + "," +
             std::to_string(result.failed);
      for (const double x : {f.nominal, f.mean, f.mean_error, f.deviation, f.deviation_error, f.min, f.max})
        csv += csv_number(x);
      for (const Quantile &q : f.quantiles)
        csv += csv_number(q.value) + csv_number(q.low) + csv_number(q.high);
      csv += "\n";
    }
  return csv;
}

} // namespace gestell::apps
