#pragma once

#include "apps/study/file/read_analysis.h"
#include "apps/study/report/study_findings.h"
#include "apps/study/runs/run_server.h"
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
  /// @param call  its folder keeps the runs of searches, verifications and draws in optimum_runs.csv; they are made
  /// side
  ///              by side by its jobs
  StudyAnalysis(const StudyFile &study, const AnalysisRequest &request, StudyRunner &runner, const StudyCall &call);

  /// What was found until `call.stop` became true.
  /// @throws std::invalid_argument for too few usable runs
  StudyFindings of(const StudyAnswer &answer);

private:
  void            find(const StudyAnswer &answer, StudyFindings &findings);
  std::string     lacking_surface(const std::vector<ResponseSurface> &surfaces) const;
  std::string     link_of(int number) const;
  void            go_on() const;
  int             next_number();
  void            keep_row(const RunRow &row, const Eigen::VectorXd &levels);
  Eigen::VectorXd values_at(const Eigen::VectorXd &xi, Eigen::MatrixXd *derivatives);
  OutputPoint     run_at(const Eigen::VectorXd &xi, Derivatives derivatives);
  StudyOptimum    optimum_of(const StudyAnswer &answer, const OutputModel &surfaces);
  RobustResult    robust_at_optimum(const StudyFindings &findings, const OutputModel &surfaces);
  Eigen::VectorXd levels_at(const Eigen::VectorXd &xi) const;

  const StudyFile           &study_;
  const AnalysisRequest     &request_;
  StudyRunner               &runner_;
  const std::atomic<bool>   &stop_;
  RowsText                   text_;
  std::filesystem::path      file_;
  std::unique_ptr<RowsFile>  rows_;
  std::vector<StudyVariable> variables_;
  int                        jobs_;
  std::unique_ptr<RunServer> server_;
  std::mutex                 mutex_;                  ///< of rows and numbers
  int                        number_         = 0;     ///< of the last run
  std::atomic<bool>          by_differences_ = false; ///< some run had no sensitivities
};

} // namespace gestell::apps
