#include "apps/study/report/study_tables.h"

namespace gestell::apps
{
CsvTable surface_csv(const std::vector<ResponseSurface> &surfaces)
{
  CsvTable csv({"output", "term", "coefficient", "confidence"});
  for (const ResponseSurface &surface : surfaces)
    for (int j = 0; j < surface.coefficients.size(); ++j)
      csv.add(surface.output.name, surface.term_name(j), unless_nan({surface.coefficients(j), surface.confidence(j)}));
  return csv;
}

CsvTable surface_quality_csv(const std::vector<ResponseSurface> &surfaces)
{
  CsvTable csv({"output", "runs", "coefficients", "R2", "adjusted R2", "predicted R2", "standard error", "PRESS",
                "lack of fit", "degrees of freedom", "pure error", "degrees of freedom", "F", "p"});
  for (const ResponseSurface &surface : surfaces)
  {
    const FitQuality &q = surface.quality;
    csv.add(surface.output.head(), q.n_runs, q.n_coefficients,
            unless_nan({q.r2, q.adjusted_r2, q.predicted_r2, q.standard_error, q.press, q.lack_of_fit,
                        double(q.lack_of_fit_dof), q.pure_error, double(q.pure_error_dof), q.lack_of_fit_F,
                        q.lack_of_fit_p_value}));
  }
  return csv;
}

CsvTable effects_csv(const std::vector<ResponseSurface> &surfaces)
{
  CsvTable csv({"output", "effect", "kind", "value", "confidence", "share of variance"});
  for (const ResponseSurface &surface : surfaces)
    for (const Effect &effect : effects_of(surface))
      csv.add(surface.output.name, effect.name, kind_word(effect.kind),
              unless_nan({effect.value, effect.confidence, effect.share}));
  return csv;
}

CsvTable front_csv(const StudyFindings &findings)
{
  std::vector<std::string> heads{"point"};
  for (const StudyVariable &variable : findings.table.variables)
    heads.push_back(variable.head());
  for (const StudyOutput &output : findings.table.outputs)
    heads.push_back(output.head());
  CsvTable csv(heads);
  int      number = 0;
  for (const ParetoPoint &point : findings.front)
  {
    std::vector<double> row;
    for (std::size_t j = 0; j < findings.table.variables.size(); ++j)
      row.push_back(findings.table.variables[j].physical(point.coded(static_cast<Eigen::Index>(j))));
    row.insert(row.end(), point.values.begin(), point.values.end());
    csv.add(++number, unless_nan(row));
  }
  return csv;
}

CsvTable robust_csv(const std::vector<RobustResult> &results)
{
  std::vector<std::string> heads{"source",
                                 "output",
                                 "draws",
                                 "failed",
                                 "nominal",
                                 "mean",
                                 "error of the mean",
                                 "standard deviation",
                                 "error of the deviation",
                                 "min",
                                 "max"};
  for (const std::string share : {"1 %", "5 %", "50 %", "95 %", "99 %"})
    heads.insert(heads.end(), {share, share + " low", share + " high"});
  CsvTable csv(heads);
  for (const RobustResult &result : results)
    for (const RobustFigures &f : result.figures)
    {
      std::vector<double> row{f.nominal, f.mean, f.mean_error, f.deviation, f.deviation_error, f.min, f.max};
      for (const Quantile &q : f.quantiles)
        row.insert(row.end(), {q.value, q.low, q.high});
      csv.add(result.source, f.output.head(), result.draws, result.failed, unless_nan(row));
    }
  return csv;
}

} // namespace gestell::apps
