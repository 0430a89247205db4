#include "apps/scene/file/scene_node.h"

#include "apps/scene/file/override_rules.h"
#include "apps/scene/file/scene_override.h"
#include "apps/scene/file/toml_text.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

using Type = SceneNode::Type;

[[noreturn]] void fail(const Place &place, const std::string &what)
{
  throw std::invalid_argument(place.text() + ": " + what);
}

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
    fail(extends->place, "extends: needs the path of another scene in quotes, got " + type_name(extends->type));
  const auto next = (std::filesystem::path(path).parent_path() / extends->text).lexically_normal().string();
  if (!std::filesystem::exists(next))
    fail(extends->place, "extends = \"" + extends->text + "\": there is no file " + next);
  if (std::count(files.begin(), files.end(), std::filesystem::weakly_canonical(next).string()))
    fail(extends->place, "extends = \"" + extends->text + "\": the scenes extend each other in a circle");

  SceneNode base = read_with_base(next, files);
  remove(own, "extends");
  remove(base, "name"); // a scene that extends another is not that other one
  if (SceneNode *run = base.find("run"), *newer = own.find("run"); run && newer)
    make_way(*run, *newer);
  if (const SceneNode *newer = own.find("frame"))
    make_way_for_frame(base, *newer);
  merge(base, own);
  return base;
}

} // namespace

const SceneNode *SceneNode::find(const std::string &key) const
{
  for (const auto &entry : entries)
    if (entry.first == key)
      return &entry.second;
  return nullptr;
}

SceneNode *SceneNode::find(const std::string &key)
{
  return const_cast<SceneNode *>(std::as_const(*this).find(key));
}

std::string type_name(Type type)
{
  switch (type)
  {
  case Type::table:
    return "a table";
  case Type::array:
    return "an array";
  case Type::text:
    return "text";
  case Type::integer:
    return "a whole number";
  case Type::real:
    return "a number";
  case Type::boolean:
    return "true or false";
  case Type::date:
    return "a date";
  }
  return "";
}

std::string described(const SceneNode &value)
{
  if (value.type == Type::text)
    return "the text \"" + value.text + "\"";
  return value.type == Type::table || value.type == Type::array || value.type == Type::date ? type_name(value.type)
                                                                                            : value.text;
}

std::string written_key(const std::string &key)
{
  const bool bare =
      !key.empty() &&
      std::all_of(key.begin(), key.end(), [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; });
  return bare ? key : "\"" + key + "\"";
}

SceneNode read_scene_file(const std::string &path, const std::vector<std::string> &overrides)
{
  SceneNode root = read_with_base(path, {});
  for (const auto &text : overrides)
    apply_override(root, text);
  return root;
}

} // namespace gestell::apps
