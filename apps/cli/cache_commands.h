#pragma once

#include "apps/scene/values/requests.h"

#include <string>

namespace gestell::apps
{

/// `gestell reduce`: a scene's frame, or the cache of frames.
struct ReduceCommandOptions
{
  bool        list = false, explain = false, prune = false;
  bool        partition = false;       ///< why every coordinate of q1 is kept
  bool        all       = false;       ///< prune every frame
  bool        check     = false;       ///< list and prune read every file whole
  std::string older_than, larger_than; ///< prune frames not used for "30 d", frames above "100 MB"
  std::string export_format;           ///< "matrix-market" or "petsc"; empty: none
};

/// Prints what the cache of reduced frames holds; files are read whole if options.check asks for it.
void list_cache(const ReduceCommandOptions &options);

/// Prints whether the cache holds the scene's frame; if not, by what the nearest one differs.
void explain_cache(const Scene &scene);

/// Removes frames that cannot be used and those that the options name; prints what went.
/// @throws std::invalid_argument if the options cannot be understood.
void prune_cache(const ReduceCommandOptions &options);

} // namespace gestell::apps
