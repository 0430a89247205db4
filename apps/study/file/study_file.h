#pragma once

#include "apps/study/file/variable_request.h"
#include "apps/study/values/study_table.h"

#include <string>
#include <utility>
#include <vector>

namespace gestell::apps
{

struct OutputRequest
{
  std::string name{}, formula{};
  Place       place{};
};

/// A parameter of the scene that a run tells, such as the time of an event.
struct RunParameter
{
  std::string parameter{}, entry{};
  Place       place{};
};

/// A study file as it is read, its variables checked; what design, surface and optimise say is read by those who do it.
struct StudyFile
{
  std::string                   path{}, name{}, description{};
  std::string                   scene{};       ///< path of the scene
  std::string                   scene_place{}; ///< where the study names it
  std::vector<SceneNode::Entry> settings{};    ///< keys that replace those of the scene
  std::vector<RunParameter>     measures{};
  std::vector<std::string>      overrides{}; ///< of the scene, from the command line
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
