#include "apps/scene/file/written_scene.h"

#include "apps/scene/file/written_text.h"
#include "fem/values/number_text.h"

namespace gestell::apps
{
namespace
{

using Type = SceneNode::Type;

std::string written_real(double value)
{
  const std::string text = exact_text(value);
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

std::string written_value(const SceneNode &value)
{
  std::string text;
  switch (value.type)
  {
  case Type::text:
    return written_text(value.text);
  case Type::real:
    return written_real(value.number);
  case Type::boolean:
    return value.boolean ? "true" : "false";
  case Type::array:
    for (const SceneNode &element : value.elements)
      text += (text.empty() ? "" : ", ") + written_value(element);
    return "[" + text + "]";
  case Type::table:
    for (const auto &[key, entry] : value.entries)
      text += (text.empty() ? " " : ", ") + written_key(key) + " = " + written_value(entry);
    return "{" + text + " }";
  default:
    return value.text;
  }
}

/// Values first, as what follows the head of an inner table belongs to that.
void write_table(const SceneNode &table, const std::string &path, std::string &text)
{
  if (!path.empty())
    text += "\n[" + path + "]\n";
  for (const auto &[key, value] : table.entries)
    if (value.type != Type::table)
      text += written_key(key) + " = " + written_value(value) + '\n';
  for (const auto &[key, value] : table.entries)
    if (value.type == Type::table)
      write_table(value, (path.empty() ? "" : path + ".") + written_key(key), text);
}

} // namespace

std::string written_scene(const SceneNode &root)
{
  std::string text;
  write_table(root, "", text);
  return text;
}

} // namespace gestell::apps
