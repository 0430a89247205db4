#include "apps/scene/file/scene_node.h"

#include "apps/scene/file/written_text.h"

#include <algorithm>
#include <cctype>

namespace gestell::apps
{

using Type = SceneNode::Type;

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
    return "a string";
  case Type::integer:
    return "an integer";
  case Type::real:
    return "a number";
  case Type::boolean:
    return "true or false";
  case Type::date:
    return "a date";
  case Type::function:
    return "a function";
  }
  return "";
}

std::string described(const SceneNode &value)
{
  if (value.type == Type::text)
    return "the string \"" + value.text + "\"";
  return value.type == Type::table || value.type == Type::array || value.type == Type::date ? type_name(value.type)
                                                                                            : value.text;
}

std::string written_key(const std::string &key)
{
  const bool bare =
      !key.empty() &&
      std::all_of(key.begin(), key.end(), [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; });
  return bare ? key : written_text(key);
}

} // namespace gestell::apps
