#pragma once

#include "apps/output/values/size_result.h"
#include "apps/sizing/error_budget.h"

#include <functional>

namespace gestell::apps
{

struct SizeOptions
{
  double                                tolerance  = 0.;    ///< relative, of the total error of each output
  double                                max_cpu    = 0.;    ///< [s] of a model; 0: any
  double                                max_memory = 0.;    ///< [byte] of the program; 0: any
  bool                                  exhaustive = false; ///< every model up to a rung finer than the chosen one, too
  std::function<void(const SizeRung &)> on_rung    = {};    ///< after each model
  /// Whether a model can be written as a scene, which may have keys that another reduction does not take; none: only
  /// the scene's reduction is tried.
  std::function<bool(const ModelVariant &)> readable = {};
  const std::atomic<bool>                  *stop     = nullptr;
};

/// The model of a rung as a variant of the scene.
struct SizedModel
{
  SizeResult   result;
  ModelVariant chosen;
};

/**
 * Climbs from the cheapest model of a scene to one whose errors, by error_budget(), stay within the tolerance of every
 * output:
 *
 *     mesh       cells of 9/4, 3/2, 1, 2/3, 4/9, ... of the scene's size
 *     reduction  0, 2, 4, 6, 8, 12, ... modes; none are the statics of the interface
 *     time       `exact` with a tolerance of 1e-3, 1e-4 ... 1e-9; where that does not treat the machine, or the scene
 *                gives its method parameters of its own, that method with 8, 4, 2, 1, 1/2, ... of its step or tolerance
 *
 * Then each other reduction is tried with as many modes, and taken if it fits in nine tenths of the CPU time.
 *
 * Where no mesh of tetrahedra will do, the climb begins again with plates swept, and counts if it gets there.
 *
 * Each step refines what takes the largest share of the tolerance.  Behind the first model that fits each part is made
 * coarser again as long as the model fits.  Errors count against the largest size of the signal, of instants against
 * the length of the run.
 *
 * @throws std::invalid_argument for a tolerance of zero or less, above 1 or below 1e-8
 */
SizedModel size_search(const Scene &scene, const std::vector<OutputName> &outputs, const SizeOptions &options);

} // namespace gestell::apps
