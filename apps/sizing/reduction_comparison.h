#pragma once

#include "apps/sizing/model_variant.h"

#include <functional>
#include <string>
#include <vector>

namespace gestell::apps
{

/// Results of a scene with one reduced frame.
struct ReductionPoint
{
  std::string         method;          ///< of [reduction]
  int                 coordinates = 0; ///< of the frame: interface and modes; without reduction its DOFs
  int                 modes       = 0;
  double              prepare_cpu = 0., run_cpu = 0.; ///< [s]
  std::vector<double> values;                         ///< of the outputs
  double              error = 0.; ///< largest difference to the reference relative to the size of the signal
  std::string         worst;      ///< output with this difference
  std::string         failure;    ///< empty: none
};

/// Comparison of the reduction methods for a scene's frame (5.5.3).
struct ReductionComparison
{
  std::vector<OutputName>     outputs;
  ReductionPoint              reference;
  std::vector<ReductionPoint> points; ///< by method, then by modes ascending
};

struct ComparisonOptions
{
  std::vector<int>                            modes{};      ///< empty: 2 to 64 by doubling, if there are as many
  bool                                        full = false; ///< the reference is the full frame
  std::function<void(const ReductionPoint &)> on_point{};
  const std::atomic<bool>                    *stop = nullptr;
};

/**
 * Runs a scene with its frame reduced by every method and several numbers of modes.  Returns the largest error of the
 * outputs relative to the full frame, condensed in each step, or to Craig-Bampton with four times the largest number of
 * modes.  A different order of events is accepted; its effect is part of the error.
 *
 * @throws std::invalid_argument if the frame is not reduced; coupling::ConvergenceFailure if the reference fails
 */
ReductionComparison compare_reductions(const Scene &scene, const std::vector<OutputName> &outputs,
                                       const ComparisonOptions &options);

} // namespace gestell::apps
