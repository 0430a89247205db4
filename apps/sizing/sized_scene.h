#pragma once

#include "apps/sizing/model_variant.h"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace gestell::apps
{

/// Entries of the scene by which it has the sizes of the model, keys and values as TOML writes them.
std::vector<std::pair<std::string, std::string>> sized_entries(const Scene &scene, const ModelVariant &model);

/// A scene file that extends the scene of a file by what is typed in the command line, "key=value", and by the sizes of
/// a model: cells, modes, method, step.  Its path is relative to `folder`, where it is meant to be.
std::string sized_scene(const Scene &scene, const std::vector<std::string> &overrides, const ModelVariant &model,
                        const std::filesystem::path &folder);

} // namespace gestell::apps
