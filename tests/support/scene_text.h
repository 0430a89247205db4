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

/// A text with double quotes for its single ones.
std::string quoted(std::string text);

/// A text with one piece of it replaced, both quoted(); the piece must occur.
std::string with(std::string text, const std::string &piece, const std::string &replacement);

/// The scene of a text, beside which a file "frame.step" lies that is never opened.
apps::Scene scene_of(const std::string &text, const std::vector<std::string> &overrides = {});

/// A small scene with one of everything: a matrix frame, a rotor, a slider, elements, a run.
std::string small_scene();

/// small_scene() with one piece replaced.
std::string small_scene(const std::string &piece, const std::string &replacement);

/// What read_scene() and check_scene() say against scene_of() a text in a file "scene.toml"; "" if nothing.  The
/// folder's path is left out of the message.
std::string complaint(const std::string &text, const std::vector<std::string> &overrides = {});

/// A frame from CAD with one of everything; one piece of its text replaced.
std::string cad_scene(const std::string &piece = "", const std::string &replacement = "");

} // namespace gestell::test
