#pragma once

#include "apps/scene/scene.h"

#include <filesystem>
#include <string>
#include <vector>

namespace gestell::test
{

/// A folder of its own for the files of one test, removed at the end.
class SceneFolder
{
public:
  SceneFolder();
  ~SceneFolder();
  SceneFolder(const SceneFolder &) = delete;

  std::string write(const std::string &name, const std::string &text) const; ///< path of the file
  std::string path(const std::string &name) const { return (folder_ / name).string(); }

private:
  std::filesystem::path folder_;
};

/// A small scene with one of everything: a matrix frame, a rotor, a slider, elements, a run.
std::string small_scene();

/// small_scene() with one piece of its text replaced; the piece must occur.
std::string small_scene(const std::string &piece, const std::string &replacement);

/// What read_scene() and check_scene() say against a text in a file "scene.toml"; "" if nothing.  The folder's path is
/// left out of the message.
std::string complaint(const std::string &text, const std::vector<std::string> &overrides = {});

/// A frame from CAD with one of everything, to be written beside a file "frame.step"; one piece of its text replaced.
std::string cad_scene(const std::string &piece = "", const std::string &replacement = "");

/// What read_scene() and check_scene() say against cad_scene() in a file "scene.toml"; "" if nothing.
std::string cad_complaint(const std::string &piece, const std::string &replacement);

} // namespace gestell::test
