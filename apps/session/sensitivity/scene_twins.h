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

/// @param root  of the scene with its overrides; its frame is `prepared`'s unless a key changes it
/// @throws std::invalid_argument where a scene is refused at such a value, or its machine is of another structure
SceneTwins scene_twins(const SceneNode &root, const std::string &path, fem::Scripts scripts, const Scene &scene,
                       PreparedMachine &prepared, std::vector<VariedKey> &keys);

} // namespace gestell::apps
