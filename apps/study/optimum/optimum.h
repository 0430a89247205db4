#pragma once

#include "apps/study/optimum/local_search.h"
#include "apps/study/optimum/optimum_task.h"

#include <cstdint>

namespace gestell::apps
{

struct OptimumOptions
{
  SearchMethod             method           = SearchMethod::gradient;
  int                      starts           = 5;    ///< the first at the middle of the box, the others Sobol points
  std::uint64_t            seed             = 1;    ///< of the starts
  double                   tolerance        = 1e-6; ///< of the variables, per width of the box
  int                      most_evaluations = 1000; ///< of a search
  const std::atomic<bool> *stop             = nullptr;
  int                      side_by_side     = 1; ///< searches in threads of their own, for a model that allows it
};

/// One search.
struct SearchTrack
{
  Eigen::VectorXd from{}, to{};
  double          objective   = 0.;
  double          violation   = 0.; ///< of the limits, per size of the output
  bool            feasible    = false;
  int             evaluations = 0; ///< that none before it had made
  std::string     reason{};
};

struct Optimum
{
  Eigen::VectorXd          coded{};
  Eigen::VectorXd          values{}; ///< of all outputs of the model
  double                   objective   = 0.;
  bool                     feasible    = false; ///< keeps all limits, to 1e-6 of their size
  int                      evaluations = 0, failed = 0;
  std::vector<SearchTrack> searches{};
};

/**
 * The best of several local searches: of those that end within the limits the one of least objective, else the one that
 * breaks them least, marked as not feasible.  Each point of the model is computed once, but
 * for those that two searches ask for at the same moment.
 *
 * @throws std::invalid_argument for a task without goals, with outputs that the model lacks, weights, scales or limits
 * that make no sense, an empty box; derivatives that are missing
 */
Optimum find_optimum(const OutputModel &model, const OptimumTask &task, const OptimumOptions &options = {});

} // namespace gestell::apps
