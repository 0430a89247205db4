#pragma once

#include "apps/session/reduced_frame_store.h"
#include "apps/study/runs/output_formulas.h"
#include "apps/study/runs/run_row.h"
#include "apps/study/runs/scene_variants.h"

#include <atomic>
#include <filesystem>

namespace gestell::apps
{

/**
 * Runs of one scene at chosen values of its variables.  What they have in common is made once: the files are read, the
 * frames reduced and kept.
 */
class StudyRunner
{
public:
  /// Checks all that can be known without a run.
  /// @param levels  of all runs [runs x variables]
  /// @param kept  folder for results of runs; empty: none are kept
  /// @throws std::invalid_argument with the place in the study
  StudyRunner(const StudyFile &study, const Eigen::MatrixXd &levels, fem::Scripts scripts,
              const std::filesystem::path &kept);

  /**
   * @param levels  values of the variables
   * @param stop    ends the run, whose row then is `waiting`; may be null
   * @return a row that is `failed` where the scene refuses the levels, the computation fails, or an output has no value
   */
  RunRow run(int number, const Eigen::VectorXd &levels, const std::atomic<bool> *stop)
  {
    return run(number, levels, stop, nullptr);
  }
  /// @param derivatives  become those of the outputs by the levels [outputs x variables]; empty where there are none
  RunRow run(int number, const Eigen::VectorXd &levels, const std::atomic<bool> *stop, Eigen::MatrixXd *derivatives);

  const SceneVariants &variants() const { return variants_; }

  /// Sets the parameters of [scene.measure], which are results of runs of the scene, to their values at these levels.
  void settle(const Eigen::VectorXd &levels, const std::atomic<bool> *stop);

private:
  /// One run with the parameters as they are measured so far.
  Result single_result(const Eigen::VectorXd &levels, const std::atomic<bool> *stop, const std::string &sensitivities);
  bool   measure(const Result &result, const Eigen::VectorXd &levels);
  Result settled_result(const Eigen::VectorXd &levels, const std::atomic<bool> *stop, const std::string &sensitivities);
  Result result_of(const Eigen::VectorXd &levels, const std::atomic<bool> *stop, const std::string &sensitivities);
  void   leave_out_unread(Scene &scene) const;
  void   read_outputs(const Result &result, const Eigen::VectorXd &levels, RunRow &row);
  void   keep(int number, const Result &result) const;

  std::vector<VariableRequest> variables_;
  SceneVariants                variants_;
  ReducedFrameStore            frames_;
  /// None where the machine or an output has none: the search then takes differences of runs.
  Eigen::MatrixXd derivatives_or_none(const Result &result, const Eigen::VectorXd &levels) const;

  OutputFormulas            outputs_;
  std::vector<RunParameter> measures_;
  std::vector<AnswerValue>  guesses_; ///< of the measures, at the middle of all ranges
  std::filesystem::path     kept_;
  bool                      units_checked_ = false; ///< outputs make sense, as a run told
};

/// Folder of a run's own results, from that of the study: "run_12".
std::string run_folder(int number);

} // namespace gestell::apps
