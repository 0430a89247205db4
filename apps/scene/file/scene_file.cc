#include "apps/scene/file/scene_file.h"

#include "apps/scene/file/override_rules.h"
#include "apps/scene/file/scene_override.h"
#include "apps/scene/file/toml_text.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

using Type = SceneNode::Type;

/// Entries of `own` over those of `base`.
void merge(SceneNode &base, const SceneNode &own)
{
  if (base.type != Type::table || own.type != Type::table)
  {
    base = own;
    return;
  }
  base.place = own.place;
  for (const auto &[key, value] : own.entries)
    if (SceneNode *inherited = base.find(key))
      merge(*inherited, value);
    else
      base.entries.emplace_back(key, value);
}

void remove(SceneNode &table, const std::string &key)
{
  auto &e = table.entries;
  e.erase(std::remove_if(e.begin(), e.end(), [&](const auto &entry) { return entry.first == key; }), e.end());
}

SceneNode read_with_base(const std::string &path, std::vector<std::string> files)
{
  const auto identity = std::filesystem::weakly_canonical(path).string();
  SceneNode  own      = parse_toml_file(path);
  files.push_back(identity);

  const SceneNode *extends = own.find("extends");
  if (!extends)
    return own;
  if (extends->type != Type::text)
    extends->place.fail("extends: needs the path of another scene in quotes, got " + type_name(extends->type));
  const auto next = (std::filesystem::path(path).parent_path() / extends->text).lexically_normal().string();
  if (!std::filesystem::exists(next))
    extends->place.fail("extends = \"" + extends->text + "\": there is no file " + next);
  if (std::count(files.begin(), files.end(), std::filesystem::weakly_canonical(next).string()))
    extends->place.fail("extends = \"" + extends->text + "\": the scenes extend each other in a circle");

  SceneNode base = read_with_base(next, files);
  remove(own, "extends");
  remove(base, "name"); // a scene that extends another is not that other one
  if (SceneNode *run = base.find("run"), *newer = own.find("run"); run && newer)
    make_way(*run, *newer);
  if (SceneNode *start = base.find("start"), *newer = own.find("start"); start && newer)
    make_way_for_start(*start, *newer);
  if (const SceneNode *newer = own.find("frame"))
    make_way_for_frame(base, *newer);
  merge(base, own);
  return base;
}

} // namespace

SceneNode read_scene_file(const std::string &path, const std::vector<std::string> &overrides)
{
  SceneNode root = read_with_base(path, {});
  for (const auto &text : overrides)
    apply_override(root, text);
  return root;
}

} // namespace gestell::apps
