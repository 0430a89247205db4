#pragma once

#include <pybind11/pybind11.h>

#include <string>

namespace gestell::python
{

/// Where a message of the program says that something is wrong.
struct MessagePlace
{
  std::string file; ///< empty: the scene is no file
  int         line = 0;
  std::string key;              ///< "run.step", "body.mass.type"; empty: the message names none
  bool        of_scene = false; ///< the message is about a scene at all
};

/// Of "press.toml:12: element.rod.stiffness: needs ...", "scene: run: unknown key 'stp'", "scene[\"run.step\"]: ...".
MessagePlace place_of(const std::string &message);

/// The message with options of the command line named as arguments: "--from" is "from_".
std::string in_python(std::string message);

/// InputError, SceneError and ComputationFailed, which what the program throws becomes.
void bind_errors(pybind11::module_ &module);

} // namespace gestell::python
