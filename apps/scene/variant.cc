#include "apps/scene/variant.h"

#include "apps/scene/file/scene_file.h"
#include "apps/scene/file/scene_override.h"

#include <algorithm>

namespace gestell::apps
{

Variant Variant::of_file(const std::string &path, const std::vector<std::string> &changes, fem::Scripts scripts)
{
  return {read_scene_file(path, changes), path, scripts, changes};
}

Variant &Variant::set(const std::string &change)
{
  apply_override(root, change);
  changes.push_back(change);
  return *this;
}

Scene Variant::scene() const
{
  return read_scene(SceneNode(root), path, scripts); // a copy: the reader marks the entries that it uses
}

void keep_signals(Scene &scene, const std::vector<std::string> &names)
{
  const auto is_other = [&](const SignalRequest &signal)
  { return std::find(names.begin(), names.end(), signal.name) == names.end(); };
  scene.signals.erase(std::remove_if(scene.signals.begin(), scene.signals.end(), is_other), scene.signals.end());
}

} // namespace gestell::apps
