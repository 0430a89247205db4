#pragma once

#include "apps/session/prepared_machine.h"
#include "apps/session/sensitivity/sensitivity_keys.h"
#include "coupling/sensitivity/parameter_twins.h"

#include <memory>
#include <string>
#include <vector>

namespace gestell::apps
{

/// The scene at a value of one entry, with its machine.
struct SceneTwin
{
  std::unique_ptr<Scene>           scene;
  std::unique_ptr<PreparedMachine> prepared;
};

/// Scenes a little below and above the value of every key, and what is differentiated of them.
struct SceneTwins
{
  std::vector<SceneTwin>                scenes; ///< of key k: 2k below, 2k + 1 above
  std::vector<coupling::ParameterTwins> twins;
};

/// @param root      of the scene with its overrides; the frame of all is that of `prepared`
/// @param keys      without those that are left out
/// @param left_out  gets a sentence for each key that has no derivative, and is left out; null: it is refused
/// @throws std::invalid_argument where a scene is refused at such a value, or its machine is of another structure
SceneTwins scene_twins(const SceneNode &root, const std::string &path, fem::Scripts scripts, const Scene &scene,
                       PreparedMachine &prepared, std::vector<VariedKey> &keys, std::vector<std::string> *left_out);

} // namespace gestell::apps
