#pragma once

#include "apps/output/values/sensitivity_result.h"
#include "apps/scene/file/scene_node.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// An entry of a scene that can be given a value a little below and above its own.
struct VariedKey
{
  SensitivityKey reported;
  std::string    text;      ///< in the file: "900 kN/mm"
  double         step = 0.; ///< of its value, > 0

  /// "parameters.c_P=(900 kN/mm)*(1 + 1e-6)", larger by `by` of its step: below zero smaller.
  std::string overridden(double by) const;
};

/// Entries named by a comma separated list, or "all": every number of [parameters] that is no expression of others.
/// @throws std::invalid_argument: an entry that does not exist (nearest named), one that is no number, is zero, or says
/// nothing about the machine
/// @param left_out  gets a sentence that names the parameters that "all" leaves out for they are zero; null: nothing
std::vector<VariedKey> varied_keys(const SceneNode &root, const std::string &list,
                                   std::vector<std::string> *left_out = nullptr);

} // namespace gestell::apps
