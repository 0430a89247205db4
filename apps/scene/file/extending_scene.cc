#include "apps/scene/file/extending_scene.h"

#include "apps/scene/file/scene_file.h"
#include "apps/scene/file/scene_override.h"
#include "apps/scene/file/written_text.h"

namespace gestell::apps
{
namespace
{

namespace fs = std::filesystem;

/// The text; if it names a file relative to its own file, the absolute path, because it will be read from elsewhere.
std::string with_whole_path(const SceneNode &node)
{
  std::error_code none;
  const fs::path  path = (fs::path(node.folder) / node.text).lexically_normal();
  return !node.folder.empty() && fs::is_regular_file(path, none) ? fs::absolute(path).string() : node.text;
}

/// The value of a key, or null.
const SceneNode *entry_of(const SceneNode &root, const std::string &key)
{
  const SceneNode *node = &root;
  for (const std::string &segment : key_segments(key, {}))
    if (!(node = node->find(segment)))
      return nullptr;
  return node;
}

/// Keys of replaced tables of the scene, which the new file would otherwise inherit in addition to the new keys.
std::string replaced_entries(const SceneNode &scene, const std::vector<SceneNode::Entry> &changes)
{
  std::string replaced;
  for (const auto &[key, value] : changes)
    if (const SceneNode *old = entry_of(scene, key);
        old && old->type == SceneNode::Type::table && value.type == SceneNode::Type::table)
      for (const auto &[name, entry] : old->entries)
        if (!value.find(name) || entry.type == SceneNode::Type::table)
          replaced += (replaced.empty() ? "" : ", ") + written_text(key + '.' + written_key(name));
  return replaced;
}

} // namespace

void add_change(std::vector<SceneNode::Entry> &changes, const std::string &key, const SceneNode &value)
{
  for (auto &[earlier, node] : changes)
    if (earlier == key)
    {
      node = value;
      return;
    }
    else if (node.type == SceneNode::Type::table && key.compare(0, earlier.size() + 1, earlier + '.') == 0)
      return apply_override(node, key.substr(earlier.size() + 1), value);
  changes.emplace_back(key, value);
}

std::string written_value(const SceneNode &value, std::string (*text_of)(const SceneNode &))
{
  std::string inside;
  const auto  add = [&](const std::string &key, const SceneNode &part)
  { inside += (inside.empty() ? "" : ", ") + key + written_value(part, text_of); };
  switch (value.type)
  {
  case SceneNode::Type::text:
    return written_text(text_of ? text_of(value) : value.text);
  case SceneNode::Type::function:
    return written_text(value.text);
  case SceneNode::Type::boolean:
    return value.boolean ? "true" : "false";
  case SceneNode::Type::array:
    for (const SceneNode &element : value.elements)
      add("", element);
    return '[' + inside + ']';
  case SceneNode::Type::table:
    for (const auto &[key, entry] : value.entries)
      add(written_key(key) + " = ", entry);
    return "{ " + inside + " }";
  default:
    return value.text;
  }
}

std::string portable_value(const SceneNode &node)
{
  return written_value(node, with_whole_path);
}

std::string extending_scene(const std::string &comment, const std::string &file,
                            const std::vector<SceneNode::Entry> &changes, const fs::path &folder)
{
  const fs::path    base     = fs::proximate(fs::absolute(file), fs::absolute(folder));
  const std::string replaced = replaced_entries(read_scene_file(file, {}), changes);
  std::string       text     = "# " + comment + "\nextends = " + written_text(base.generic_string()) + '\n';
  text += (replaced.empty() ? "" : "without = [" + replaced + "]\n") + '\n';
  for (const auto &[key, value] : changes)
    text += key + " = " + portable_value(value) + '\n';
  return text;
}

} // namespace gestell::apps
