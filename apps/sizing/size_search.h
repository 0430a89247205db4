#pragma once

#include "apps/output/values/size_result.h"
#include "apps/sizing/error_budget.h"

#include <functional>

namespace gestell::apps
{

struct SizeOptions
{
  double                                    tolerance   = 0.;    ///< relative, of the total error of each output
  double                                    max_cpu     = 0.;    ///< [s] of a model; 0: any
  double                                    max_memory  = 0.;    ///< [byte] of the program; 0: any
  bool                                      exhaustive  = false; ///< every model about the chosen one, too
  std::function<void(const SizeRung &)>     on_rung     = {};    ///< after each model that was judged
  std::function<void(const SizeForecast &)> on_forecast = {};    ///< before it is
  const std::atomic<bool>                  *stop        = nullptr;
};

/// The model of a rung as a variant of the scene.
struct SizedModel
{
  SizeResult   result;
  ModelVariant chosen;
};

/**
 * The smallest model of a scene whose errors, by error_budget(), stay within the tolerance of every output.
 *
 * A coarse model, cells of 9/4 of the scene's size, 8 modes, integration to 1e-3 or in eight of the scene's steps, is
 * judged first.  How many modes suffice is seen on its frame, whose first modes are a frame of fewer.  Its errors in
 * mesh and time tell by their orders which model of each kind of mesh, tetrahedra with straight or curved sides and
 * swept plates, will do; the one with the fewest coordinates is judged, and the laws are corrected by what it shows
 * (size_laws.h), until no smaller one is expected, or what it costs would take all above ten runs of it.  The best is
 * compared with its answer on cells of 2/3 the size, and must agree.
 *
 * Errors count against the largest size of the signal, of instants against the length of the run.
 *
 * @throws std::invalid_argument for a tolerance of zero or less, above 1 or below 1e-8
 */
SizedModel size_search(const Scene &scene, const std::vector<OutputName> &outputs, const SizeOptions &options);

} // namespace gestell::apps
