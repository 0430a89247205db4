#include "apps/study/results/optimum_scene.h"

#include "apps/scene/file/scene_file.h"
#include "apps/scene/file/scene_override.h"
#include "apps/scene/file/written_text.h"

namespace gestell::apps
{
namespace
{

/// The entry of a scene, or null.
const SceneNode *entry_of(const SceneNode &root, const std::string &key)
{
  const SceneNode *node = &root;
  for (const std::string &segment : key_segments(key, {}))
    if (!(node = node->find(segment)))
      return nullptr;
  return node;
}

/// What the scene has in tables that the study replaces, and would be inherited beside the new entries.
std::vector<std::string> replaced_entries(const SceneNode &scene, const std::vector<SceneNode::Entry> &changes)
{
  std::vector<std::string> replaced;
  for (const auto &[key, value] : changes)
    if (const SceneNode *old = entry_of(scene, key);
        old && old->type == SceneNode::Type::table && value.type == SceneNode::Type::table)
      for (const auto &[name, entry] : old->entries)
        if (!value.find(name) || entry.type == SceneNode::Type::table)
          replaced.push_back(key + '.' + written_key(name));
  return replaced;
}

std::string without_line(const std::vector<std::string> &entries)
{
  std::string line;
  for (const std::string &entry : entries)
    line += (line.empty() ? "" : ", ") + written_text(entry);
  return line.empty() ? "" : "without = [" + line + "]\n";
}

} // namespace

std::string optimum_scene(const StudyFile &study, const SceneVariants &variants, const Eigen::VectorXd &levels,
                          const std::filesystem::path &folder)
{
  const auto base =
      std::filesystem::proximate(std::filesystem::absolute(study.scene), std::filesystem::absolute(folder));
  std::string text = "# The optimum of the study " + study.name +
                     ", by gestell study.\nextends = " + written_text(base.generic_string()) +
                     "\nname    = " + written_text(study.name + "_optimum") + "\n";
  const auto changes = variants.changes_at(levels);
  text += without_line(replaced_entries(read_scene_file(study.scene, {}), changes)) + '\n';
  for (const auto &[key, value] : changes)
    text += key + " = " + toml_value(value) + '\n';
  return text;
}

} // namespace gestell::apps
