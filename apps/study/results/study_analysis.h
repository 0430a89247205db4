#pragma once

#include "apps/study/file/read_analysis.h"
#include "apps/study/report/study_findings.h"
#include "apps/study/runs/study_answer.h"

namespace gestell::apps
{

/// Tries the surfaces on the points before any run.
/// @throws std::invalid_argument for a design that cannot tell their coefficients, with the place in the study
void check_analysis(const AnalysisRequest &request, const StudyFile &study, const StudyPoints &points);

/// What is made of a study's rows: surfaces, optimum, front, scatter.
class StudyAnalysis
{
public:
  /// @param folder  of the study: runs that a search or a verification makes are kept there in optimum_runs.csv
  StudyAnalysis(const StudyFile &study, const AnalysisRequest &request, StudyRunner &runner,
                const std::filesystem::path &folder, const std::atomic<bool> &stop);

  /// @throws std::invalid_argument for too few usable runs
  StudyFindings of(const StudyAnswer &answer);

private:
  Eigen::VectorXd values_at(const Eigen::VectorXd &xi, Eigen::MatrixXd *derivatives);
  OutputPoint     run_at(const Eigen::VectorXd &xi, Derivatives derivatives);
  StudyOptimum    optimum_of(const StudyAnswer &answer, const OutputModel &surfaces);
  RobustResult    robust_at(const Eigen::VectorXd &nominal, const StudyTable &table, const OutputModel &surfaces);
  Eigen::VectorXd levels_at(const Eigen::VectorXd &xi) const;

  const StudyFile           &study_;
  const AnalysisRequest     &request_;
  StudyRunner               &runner_;
  const std::atomic<bool>   &stop_;
  RowsText                   text_;
  std::filesystem::path      file_;
  std::unique_ptr<RowsFile>  rows_;
  std::vector<StudyVariable> variables_;
  int                        number_         = 0;     ///< of the last run
  bool                       by_differences_ = false; ///< some run had no sensitivities
};

} // namespace gestell::apps
