#pragma once

#include "apps/scene/file/scene_node.h"
#include "apps/study/values/study_variable.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// A scene key that a study varies, as given in its file.
struct VariableRequest
{
  StudyVariable                               variable;
  std::vector<std::string>                    keys{};    ///< all that take its value, variable.key the first
  std::vector<SceneNode>                      choices{}; ///< of a variable with choices: what the words stand for
  std::vector<std::pair<double, std::string>> files{};   ///< of a variable that is varied by files: one for each level
  std::string                                 place{};
  std::string                                 folder{}; ///< where paths among its words or files start

  /// As a value of the scene is written: 900 kN/mm, linear, true.
  std::string text(double level) const { return variable.text(level); }
  /// The file that stands for a level; empty: the level is a value of the scene.
  std::string file(double level) const;
  /// The level of a value written in the study: "900 kN/mm", 900, "linear".
  /// @throws std::invalid_argument with the place of the value
  double level(const SceneNode &value) const;
};

/// Takes the unit of a value for that of the variable, if it has none yet.
/// @throws std::invalid_argument with the place of the value for a value that is not a number, and for another unit
double in_unit(const SceneNode &value, StudyVariable &variable, const std::string &key);

/// A number, with or without a unit.
bool starts_with_number(const SceneNode &value);

} // namespace gestell::apps
