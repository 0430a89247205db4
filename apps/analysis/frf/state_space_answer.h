#pragma once

#include "apps/analysis/frf/response_search.h"
#include "apps/output/values/state_space_model.h"

namespace gestell::apps
{

/// The scene's machine at an operating point, with inputs along options.from and outputs options.to; on the reduced
/// frame where it has an unreduced one.
/// @throws std::invalid_argument for options that do not fit, and where the machine is not of this form
StateSpaceModel state_space_of(const Scene &scene, PreparedMachine &prepared, const FrfOptions &options);

} // namespace gestell::apps
