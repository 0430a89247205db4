#pragma once

#include "apps/cli/commands.h"
#include "apps/scene/values/requests.h"

namespace gestell::apps
{

/// Prints what the cache of reduced frames holds; files are read whole if options.check asks for it.
void list_cache(const ReduceCommandOptions &options);

/// Prints whether the cache holds the scene's frame; if not, by what the nearest one differs.
void explain_cache(const Scene &scene);

/// Removes frames that cannot be used and those that the options name; prints what went.
/// @throws std::invalid_argument if the options cannot be understood.
void prune_cache(const ReduceCommandOptions &options);

} // namespace gestell::apps
