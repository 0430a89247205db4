#include "apps/scene/file/scene_file.h"

#include "apps/scene/file/override_rules.h"
#include "apps/scene/file/scene_override.h"
#include "apps/scene/file/toml_text.h"
#include "fem/values/named_file.h"
#include "fem/values/nearest_name.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

using Type = SceneNode::Type;

/// Merges the keys of `own` into `base`, where they have priority.
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

/// Removes one table "joint.cylinder", or a key in it, from the inherited scene.
void leave_out(SceneNode &base, const SceneNode &path)
{
  const auto        refuse = [&](const std::string &why) { path.place.fail("without: '" + path.text + "': " + why); };
  const std::size_t dot    = path.text.find('.');
  if (path.type != Type::text || dot == std::string::npos)
    refuse("needs a table and a name, such as \"joint.cylinder\"");
  SceneNode  *table = base.find(path.text.substr(0, dot));
  std::string name  = path.text.substr(dot + 1);
  if (table && !table->find(name)) // a key in a table, "joint.cylinder.motion"
  {
    const auto segments = key_segments(name, path.place);
    name                = segments.back();
    for (std::size_t i = 0; table && i + 1 < segments.size(); ++i)
      table = table->find(segments[i]);
  }
  if (!table || !table->find(name))
  {
    std::vector<std::string> valid;
    for (const auto &[key, value] : base.entries)
      for (const auto &[inner, unused] : value.entries)
        valid.push_back(key + "." + inner);
    refuse("the base scene has no such table" + suggestion(path.text, valid));
  }
  remove(*table, name);
}

/// Takes out what `own` does not want of its base.
void leave_out_listed(SceneNode &base, SceneNode &own)
{
  const SceneNode *without = own.find("without");
  if (!without)
    return;
  if (without->type != Type::array)
    without->place.fail("without: needs a list of names, such as [\"joint.cylinder\"], got " +
                        type_name(without->type));
  for (const SceneNode &path : without->elements)
    leave_out(base, path);
  remove(own, "without");
}

SceneNode with_base(SceneNode own, const std::string &path, std::vector<std::string> files)
{
  files.push_back(std::filesystem::weakly_canonical(path).string());

  const SceneNode *extends = own.find("extends");
  if (const SceneNode *without = own.find("without"); without && !extends)
    without->place.fail("without: removes tables of a base scene, but there is no 'extends'; remove it");
  if (!extends)
    return own;
  if (extends->type != Type::text)
    extends->place.fail("extends: needs the path of another scene in quotes, got " + type_name(extends->type));
  const auto next = (std::filesystem::path(path).parent_path() / extends->text).lexically_normal().string();
  if (const std::string reason = fem::why_unreachable(next); !reason.empty())
    extends->place.fail("extends = \"" + extends->text + "\": the file " + reason);
  if (!std::filesystem::exists(next))
    extends->place.fail("extends = \"" + extends->text + "\": there is no file " + next);
  if (std::count(files.begin(), files.end(), std::filesystem::weakly_canonical(next).string()))
    extends->place.fail("extends = \"" + extends->text + "\": the scenes extend each other cyclically");
  constexpr std::size_t most_extended = 50; // of scenes that extend each other: each takes some of the stack
  if (files.size() > most_extended)
    extends->place.fail("extends = \"" + extends->text + "\": more than " + std::to_string(most_extended) +
                        " scenes extend each other; merge some of them");

  SceneNode base = with_base(parse_toml_file(next), next, files);
  remove(own, "extends");
  leave_out_listed(base, own);
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

SceneNode with_extended(const SceneNode &own, const std::string &path)
{
  return with_base(own, path, {});
}

SceneNode read_scene_file(const std::string &path, const std::vector<std::string> &overrides)
{
  SceneNode root = with_base(parse_toml_file(path), path, {});
  for (const auto &text : overrides)
    apply_override(root, text);
  return root;
}

} // namespace gestell::apps
