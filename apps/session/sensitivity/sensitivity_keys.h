#pragma once

#include "apps/output/values/sensitivity_result.h"
#include "apps/scene/file/scene_node.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// A scene key whose value can be perturbed.
struct VariedKey
{
  SensitivityKey reported;
  std::string    text;      ///< in the file: "900 kN/mm"
  double         step = 0.; ///< absolute step of its value, > 0

  /// Override "parameters.c_P=(900 kN/mm)*(1 + 1e-6)", changed by `by` steps; negative: smaller.
  std::string overridden(double by) const;
};

/// Keys of a comma-separated list, or "all": every number of [parameters] that is not an expression of others.
/// @throws std::invalid_argument for a key that does not exist (with the most similar one), is not a number, is zero,
/// or does not affect the machine
/// @param left_out  receives a sentence with the parameters that "all" omits because they are zero; null: not used
std::vector<VariedKey> varied_keys(const SceneNode &root, const std::string &list,
                                   std::vector<std::string> *left_out = nullptr);

} // namespace gestell::apps
