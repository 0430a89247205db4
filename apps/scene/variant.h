#pragma once

#include "apps/scene/scene.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// A scene file as data, with changes of its keys.
struct Variant
{
  SceneNode                root{}; ///< of the file, those that it extends, and the changes
  std::string              path{}; ///< of the file, or where it would be
  fem::Scripts             scripts = fem::Scripts::harmless;
  std::vector<std::string> changes{}; ///< "key=value", in their order

  /// @throws std::invalid_argument as read_scene_file()
  static Variant of_file(const std::string &path, const std::vector<std::string> &changes = {},
                         fem::Scripts scripts = fem::Scripts::harmless);

  Variant &set(const std::string &change); ///< "key=value", as after --set
  Variant  with(const std::string &change) const { return Variant(*this).set(change); }
  Scene    scene() const; ///< @throws std::invalid_argument as read_scene()
};

/// Removes all other signals.
void keep_signals(Scene &scene, const std::vector<std::string> &names);

} // namespace gestell::apps
