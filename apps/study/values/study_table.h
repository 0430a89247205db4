#pragma once

#include "apps/study/values/design.h"

namespace gestell::apps
{

struct StudyOutput
{
  std::string name{};
  std::string unit{}; ///< empty: none

  std::string head() const { return unit.empty() ? name : name + " [" + unit + "]"; }
};

enum class RunStatus
{
  waiting,
  done,
  failed
};

/// What is known of a run beside its numbers.
struct StudyRun
{
  RunStatus   status = RunStatus::waiting;
  std::string message{}; ///< why it failed
  std::string link{};    ///< of its own results, from the folder of the study; empty: none were kept
  double      cpu_s = 0.;
};

/// One row per run of a study.
struct StudyTable
{
  std::vector<StudyVariable> variables{};
  std::vector<StudyOutput>   outputs{};
  Eigen::MatrixXd            levels{}; ///< runs x variables, physical
  Eigen::MatrixXd            values{}; ///< runs x outputs; nan where a run has none
  std::vector<StudyRun>      runs{};

  int n_runs() const { return static_cast<int>(runs.size()); }
  int n_done() const;

  /// Runs that are done and have a value of the output.
  std::vector<int> runs_with(int output) const;
  /// Runs that are done and have a value of every output that any of them has, with their numbers in this table.
  std::vector<int> usable_runs() const;
  StudyTable       usable() const;

  Eigen::MatrixXd coded() const { return coded_points(levels, variables); }

  /// @throws std::invalid_argument if there is none, with the names there are
  int output_index(const std::string &name) const;
  int variable_index(const std::string &name) const;
};

/// A table of waiting runs at these points.
StudyTable waiting_table(const Design &design, const std::vector<StudyVariable> &variables,
                         const std::vector<StudyOutput> &outputs);

} // namespace gestell::apps
