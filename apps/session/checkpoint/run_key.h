#pragma once

#include "apps/scene/file/scene_node.h"
#include "coupling/machine/initial_state.h"
#include "coupling/machine/machine.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// An input of a run, with its SHA-256.
struct KeyPart
{
  std::string what, hash;
};

KeyPart version_part(); ///< of the program
/// Keys of a scene, or of a part of it, and the bytes of the files that it names.
KeyPart scene_part(const std::string &what, const SceneNode &scene);
KeyPart files_part(const std::string &what, const SceneNode &scene);

/**
 * All inputs of a run: the program file, the scene keys with overrides (comments and the order of lines do not count),
 * the bytes of referenced files, the matrices of the machine and its initial state.
 */
std::vector<KeyPart> run_key(const SceneNode &scene, const coupling::Machine &machine,
                             const coupling::InitialState &start);

} // namespace gestell::apps
