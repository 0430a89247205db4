#pragma once

#include "apps/sizing/model_variant.h"

#include <functional>
#include <string>
#include <vector>

namespace gestell::apps
{

/// A scene on one reduced frame.
struct ReductionPoint
{
  std::string         method;          ///< of [reduction]
  int                 coordinates = 0; ///< of the frame: interface and modes; all of them where nothing is reduced
  int                 modes       = 0;
  double              prepare_cpu = 0., run_cpu = 0.; ///< [s]
  std::vector<double> values;                         ///< of the outputs
  double              error = 0.; ///< largest difference to the reference, of the size of the signal
  std::string         worst;      ///< the output that has it
  std::string         failure;    ///< empty: none
};

/// The reductions of a scene's frame beside each other (5.5.3).
struct ReductionComparison
{
  std::vector<OutputName>     outputs;
  ReductionPoint              reference;
  std::vector<ReductionPoint> points; ///< by method, then by modes ascending
};

struct ComparisonOptions
{
  std::vector<int>                            modes{};      ///< empty: 2 to 64 by doubling, as many as there are
  bool                                        full = false; ///< the reference is the full frame
  std::function<void(const ReductionPoint &)> on_point{};
  const std::atomic<bool>                    *stop = nullptr;
};

/**
 * Runs a scene with its frame reduced by every method, over numbers of modes, and tells the largest error of the
 * outputs against the full frame, condensed in each step, or against Craig-Bampton with four times the largest number
 * of modes. Of an event whose order differs the error is what the outputs show.
 *
 * @throws std::invalid_argument if the frame is not reduced; coupling::ConvergenceFailure if the reference fails
 */
ReductionComparison compare_reductions(const Scene &scene, const std::vector<OutputName> &outputs,
                                       const ComparisonOptions &options);

} // namespace gestell::apps
