#pragma once

#include "apps/cli/command.h"
#include "apps/scene/values/requests.h"

#include <filesystem>

namespace gestell::apps
{

/// Folder for results: -o, or else results/<scene name>.
inline std::filesystem::path results_path(const CommonOptions &options, const Scene &scene)
{
  return options.folder.empty() ? std::filesystem::path("results") / scene.name : std::filesystem::path(options.folder);
}

} // namespace gestell::apps
