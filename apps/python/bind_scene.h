#pragma once

#include <pybind11/pybind11.h>

namespace gestell::python
{

/// Binds the scene class that gestell.py wraps.
void bind_scene(pybind11::module_ &module);

} // namespace gestell::python
