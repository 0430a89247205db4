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
struct PerturbedScenes
{
  std::vector<SceneTwin>                scenes; ///< of key k: 2k below, 2k + 1 above
  std::vector<coupling::ParameterTwins> twins;
  std::vector<std::string>              warnings;
};

/// A scene as it was read, with its overrides.
struct SceneFileAt
{
  SceneNode    root;
  std::string  path;
  fem::Scripts scripts;
};

/// The frame of all is that of `prepared`; with entries on which it depends it is moved by its derivative, a quotient
/// of two reductions.
/// @param keys      without those that are left out; those of the frame are told how its derivative was found
/// @param left_out  gets a sentence for each key that has no derivative, and is left out; null: it is refused
/// @param progress  of reductions
/// @throws std::invalid_argument where a scene is refused at such a value, or its machine is of another structure
PerturbedScenes perturbed_scenes(const SceneFileAt &file, const Scene &scene, PreparedMachine &prepared,
                                 std::vector<VariedKey> &keys, std::vector<std::string> *left_out,
                                 const coupling::Progress &progress);

} // namespace gestell::apps
