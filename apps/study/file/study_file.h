#pragma once

#include "apps/scene/file/scene_node.h"
#include "apps/study/values/study_table.h"

#include <string>
#include <utility>
#include <vector>

namespace gestell::apps
{

/// An entry of the scene that a study varies, as its file tells it.
struct VariableRequest
{
  StudyVariable            variable;
  std::vector<std::string> keys{};    ///< all that take its value, variable.key the first
  std::vector<std::string> words{};   ///< of a variable that takes words or truths: level k is the k-th of them
  std::vector<SceneNode>   choices{}; ///< of a variable with choices: what the words stand for
  std::string              place{};

  /// As a value of the scene is written: 900 kN/mm, linear, true.
  std::string text(double level) const;
  /// The level of a value written in the study: "900 kN/mm", 900, "linear".
  /// @throws std::invalid_argument with the place of the value
  double level(const SceneNode &value) const;
};

struct OutputRequest
{
  std::string name{}, formula{};
  Place       place{};
};

/// A study file as it is read, its variables checked; what design, surface and optimise say is read by those who do it.
struct StudyFile
{
  std::string                   path{}, name{}, description{};
  std::string                   scene{};       ///< path of the scene
  std::string                   scene_place{}; ///< where the study names it
  std::vector<SceneNode::Entry> settings{};    ///< entries of the scene that hold in place of its own
  std::vector<std::string>      overrides{};   ///< of the scene, from the command line
  std::vector<VariableRequest>  variables{};
  std::vector<OutputRequest>    outputs{};
  SceneNode                     root{}; ///< the whole file
  bool                          keep = false;

  std::vector<StudyVariable> values() const;
};

/// @param overrides  "key.path=value", of the study where the key begins with one of its tables, else of the scene
/// @throws std::invalid_argument with file and line
StudyFile read_study(const std::string &path, const std::vector<std::string> &overrides);

} // namespace gestell::apps
