#pragma once

#include "apps/scene/values/requests.h"

#include <string>

namespace gestell::apps
{

/// Options of `gestell reduce` for a scene's frame or the cache of frames.
struct ReduceCommandOptions
{
  bool        list = false, explain = false, prune = false;
  bool        partition = false;       ///< reasons why every coordinate of q1 is retained
  bool        all       = false;       ///< prune every frame
  bool        check     = false;       ///< list and prune read every file completely
  std::string older_than, larger_than; ///< prune frames not used for "30 d", frames above "100 MB"
  std::string export_format;           ///< "matrix-market" or "petsc"; empty: none
};

/// Prints the contents of the cache of reduced frames; files are read completely if options.check is set.
void list_cache(const ReduceCommandOptions &options);

/// Prints whether the cache contains the scene's frame; if not, how the most similar one differs.
void explain_cache(const Scene &scene);

/// Removes unusable frames and those that the options select; prints the removed frames.
/// @throws std::invalid_argument if the options are invalid.
void prune_cache(const ReduceCommandOptions &options);

} // namespace gestell::apps
