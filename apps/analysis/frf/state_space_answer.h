#pragma once

#include "apps/analysis/frf/response_search.h"
#include "apps/output/values/state_space_model.h"

namespace gestell::apps
{

/// The scene's machine at an operating point as state-space model, with inputs options.from and outputs options.to; on
/// the reduced frame if there is an unreduced one.
/// @throws std::invalid_argument for invalid options, and if the machine has no such model
StateSpaceModel state_space_of(const Scene &scene, PreparedMachine &prepared, const FrfOptions &options);

} // namespace gestell::apps
