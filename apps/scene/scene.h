#pragma once

#include "apps/scene/file/scene_node.h"
#include "apps/scene/values/requests.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/**
 * Reads and validates a scene without computing anything (docs/reference/scene is the reference of its keys).
 *
 * @param overrides  of the command line, "key.path=value".
 * @param scripts    policy for gmsh scripts of the scene; a scene cannot change it.
 * @throws std::invalid_argument "press.toml:12: body.crank.inertia: ..." for every error in the scene.
 */
Scene read_scene(const std::string &path, const std::vector<std::string> &overrides = {},
                 fem::Scripts scripts = fem::Scripts::harmless);

/// The same for a file that has been read (read_scene_file()).
Scene read_scene(const SceneNode &root, const std::string &path, fem::Scripts scripts);

} // namespace gestell::apps
