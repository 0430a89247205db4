#pragma once

#include "apps/sizing/model_variant.h"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace gestell::apps
{

/// Scene keys that define the sizes of the model, with values in TOML syntax.
std::vector<std::pair<std::string, std::string>> sized_entries(const Scene &scene, const ModelVariant &model);

/// Text of a scene file that extends the scene's file by the overrides of the command line, "key=value", and by the
/// sizes of a model: elements, modes, method, step.  The path to the extended file is relative to `folder`, the
/// intended folder of the text.
std::string sized_scene(const Scene &scene, const std::vector<std::string> &overrides, const ModelVariant &model,
                        const std::filesystem::path &folder);

} // namespace gestell::apps
