#pragma once

#include "apps/scene/file/scene_node.h"

#include <pybind11/pybind11.h>

#include <string>

namespace gestell::python
{

/// A value of Python as an entry of a scene: dict, list, tuple or array, str, bool, int, float, path.
/// @param folder  relative paths in it start here
/// @param key     its path in the scene, for messages
/// @throws std::invalid_argument with the place, for any other type and for keys that are no text
apps::SceneNode node_of(pybind11::handle value, const apps::Place &place, const std::string &folder,
                        const std::string &key = "");

/// The entry as a value of Python: dict, list, str, bool, int or float.
pybind11::object value_of(const apps::SceneNode &node);

} // namespace gestell::python
