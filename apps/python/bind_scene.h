#pragma once

#include <pybind11/pybind11.h>

namespace gestell::python
{

/// The scene that gestell.py wraps.
void bind_scene(pybind11::module_ &module);

} // namespace gestell::python
