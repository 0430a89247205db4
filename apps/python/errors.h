#pragma once

#include <pybind11/pybind11.h>

#include <string>

namespace gestell::python
{

/// Location in an error message of the program.
struct MessagePlace
{
  std::string file; ///< empty: the scene has no file
  int         line = 0;
  std::string key;              ///< "run.step", "body.mass.type"; empty: the message contains none
  bool        of_scene = false; ///< whether the message is about a scene
};

/// Parses "press.toml:12: element.rod.stiffness: needs ...", "scene: run: unknown key 'stp'", "scene[\"run.step\"]:
/// ...".
MessagePlace place_of(const std::string &message);

/// The message with command-line options renamed to arguments: "--from" becomes "from_".
std::string in_python(std::string message);

/// Binds InputError, SceneError and ComputationFailed, to which exceptions of the program are converted.
void bind_errors(pybind11::module_ &module);

pybind11::object computation_failed(const std::string &why);

/// Ctrl-C and sys.exit() in a function are not failures of it: raises them.
void raise_if_it_ends_the_program(const pybind11::object &raised);

} // namespace gestell::python
