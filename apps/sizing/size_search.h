#pragma once

#include "apps/output/values/size_result.h"
#include "apps/sizing/error_budget.h"

#include <functional>

namespace gestell::apps
{

struct SizeOptions
{
  double                                    tolerance   = 0.;    ///< relative total error allowed for each output
  double                                    max_cpu     = 0.;    ///< [s] for one model; 0: unlimited
  double                                    max_memory  = 0.;    ///< [byte] of the program; 0: unlimited
  bool                                      exhaustive  = false; ///< also all models around the chosen one
  std::function<void(const SizeRung &)>     on_rung     = {};    ///< after each model with its errors
  std::function<void(const SizeForecast &)> on_forecast = {};    ///< before each model
  const std::atomic<bool>                  *stop        = nullptr;
};

/// A model found by the search, as a variant of the scene.
struct SizedModel
{
  SizeResult   result;
  ModelVariant chosen;
};

/**
 * The smallest model of a scene whose errors, by error_budget(), stay within the tolerance of every output.
 *
 * The errors of a coarse model are estimated first: elements of 9/4 of the scene's size, 8 modes, integration to 1e-3
 * or with eight of the scene's steps.  The number of modes is chosen on its frame, which can be truncated.  From its
 * mesh and time errors and their orders the search predicts a sufficient model for each kind of mesh: tetrahedra with
 * straight or curved sides, and swept plates.  It estimates the errors of the one with the fewest DOFs and corrects the
 * laws (size_laws.h).  The search ends if no smaller model is expected, or if its cost would exceed ten runs of that
 * model. The best model is verified by a run with elements of 2/3 of its size.
 *
 * Errors are relative to the largest value of the signal; errors of times are relative to the length of the run.
 *
 * @throws std::invalid_argument for a tolerance of zero or less, above 1 or below 1e-8
 */
SizedModel size_search(const Scene &scene, const std::vector<OutputName> &outputs, const SizeOptions &options);

} // namespace gestell::apps
