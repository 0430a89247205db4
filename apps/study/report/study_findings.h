#pragma once

#include "apps/study/optimum/pareto.h"
#include "apps/study/optimum/robust.h"
#include "apps/study/optimum/row_choice.h"
#include "apps/study/surface/effects.h"

#include <optional>

namespace gestell::apps
{

/// The optimum with the run that verifies it.
struct StudyOptimum
{
  std::string                    source = "surface"; ///< what was searched on: "surface" or "runs"
  OptimumTask                    task{};
  Optimum                        found{};
  std::optional<Eigen::VectorXd> verified{}; ///< outputs of a run there, where the search was on a surface
  std::optional<Eigen::VectorXd> nominal{};  ///< outputs at the middle of the ranges, to compare with
  std::string                    link{};     ///< of the verifying run; empty: none
};

/// All that a study found; what it did not ask for is empty.
struct StudyFindings
{
  std::string                  name{}, description{};
  std::string                  scene{};   ///< file, as the study names it
  std::string                  version{}; ///< of gestell
  std::vector<std::string>     warnings{};
  Design                       design{};
  StudyTable                   table{};
  std::vector<ResponseSurface> surfaces{};
  std::optional<StudyOptimum>  optimum{};
  std::optional<RowChoice>     choice{};     ///< the best of the runs that were made
  OptimumTask                  front_task{}; ///< whose goals the front has as axes; of runs alone, too
  std::vector<ParetoPoint>     front{};      ///< on the surfaces; empty: none was asked for
  std::vector<RobustResult>    robust{};
};

} // namespace gestell::apps
