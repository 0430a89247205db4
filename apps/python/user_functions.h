#pragma once

#include "apps/scene/file/scene_node.h"

#include <pybind11/pybind11.h>

#include <string>

namespace gestell::python
{

/**
 * Functions of Python as entries of a scene: `Law` and `UserSignal` of the module, whose objects are the origin of an
 * apps::UserValue.  Calls take the interpreter lock; an exception becomes one of C++ with the traceback as its text,
 * and is kept as the cause of the failure that follows.
 */
void bind_user_functions(pybind11::module_ &module);

/// Whether a Python object is such an entry, and then its node's value.
bool fill_function_node(pybind11::handle value, apps::SceneNode &node);
/// The Python object of a function node.
pybind11::object function_object(const apps::SceneNode &node);

/// The traceback of an exception, as Python prints it.
std::string traceback_text(const pybind11::object &error);

/// The last exception of the scene's functions since the call before; None: there was none.  Needs the lock.
pybind11::object take_raised(const apps::SceneNode &root);

} // namespace gestell::python
