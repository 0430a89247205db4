#pragma once

#include "apps/scene/file/scene_node.h"

#include <pybind11/pybind11.h>

#include <string>

namespace gestell::python
{

/// Converts a value of Python to a scene value: dict, list, tuple or array, str, bool, int, float, path.
/// @param folder  base of relative paths in it
/// @param key     its path in the scene, for messages
/// @throws std::invalid_argument with the location, for any other type and for keys that are not strings
apps::SceneNode node_of(pybind11::handle value, const apps::Place &place, const std::string &folder,
                        const std::string &key = "");

/// Converts a scene value to Python: dict, list, str, bool, int or float.
pybind11::object value_of(const apps::SceneNode &node);

} // namespace gestell::python
