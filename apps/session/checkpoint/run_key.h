#pragma once

#include "apps/scene/file/scene_node.h"
#include "coupling/machine/initial_state.h"
#include "coupling/machine/machine.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// Something that a run depends on, and the SHA-256 of it.
struct KeyPart
{
  std::string what, hash;
};

/**
 * All that a run depends on: the program's own bytes, the entries of the scene with what was overridden (comments and
 * the order of lines do not count), the bytes of files that it names, the matrices of the machine and its start.
 */
std::vector<KeyPart> run_key(const SceneNode &scene, const coupling::Machine &machine,
                             const coupling::InitialState &start);

} // namespace gestell::apps
