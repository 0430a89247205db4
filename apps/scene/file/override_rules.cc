#include "apps/scene/file/override_rules.h"

#include <algorithm>
#include <cctype>

namespace gestell::apps
{
namespace
{

void take_away(SceneNode &table, const std::vector<std::string> &keys)
{
  auto      &entries = table.entries;
  const auto goes    = [&](const SceneNode::Entry &entry)
  { return std::find(keys.begin(), keys.end(), entry.first) != keys.end() && !from_command_line(entry.second); };
  entries.erase(std::remove_if(entries.begin(), entries.end(), goes), entries.end());
}

void take_all_away(SceneNode &table)
{
  auto &entries = table.entries;
  entries.erase(std::remove_if(entries.begin(), entries.end(),
                               [](const SceneNode::Entry &entry) { return !from_command_line(entry.second); }),
                entries.end());
}

void add_changes(const SceneNode &table, std::string &changes)
{
  for (const auto &[key, value] : table.entries)
    if (from_command_line(value))
      changes += (changes.empty() ? "" : ", ") + value.place.file;
    else
      add_changes(value, changes);
}

/// Whether a name occurs in an expression.
bool occurs(const std::string &name, const std::string &text)
{
  const auto in_name = [&](std::size_t i)
  { return i < text.size() && (std::isalnum(static_cast<unsigned char>(text[i])) || text[i] == '_'); };
  for (std::size_t i = text.find(name); i != std::string::npos; i = text.find(name, i + 1))
    if (!(i > 0 && in_name(i - 1)) && !in_name(i + name.size()))
      return true;
  return false;
}

/// What stands in double quotes.
std::string quoted_parts(const std::string &text)
{
  std::string parts;
  for (std::size_t begin = text.find('"'), end; begin != std::string::npos; begin = text.find('"', end + 1))
  {
    end = text.find('"', begin + 1);
    if (end == std::string::npos)
      break;
    parts += text.substr(begin + 1, end - begin - 1) + ' ';
  }
  return parts;
}

std::string method_in(const SceneNode &table, const std::string &otherwise)
{
  const SceneNode *method = table.find("method");
  return method ? method->text : otherwise;
}

} // namespace

bool from_command_line(const SceneNode &node)
{
  return node.place.file.rfind("--set", 0) == 0;
}

std::string changes_words(const SceneNode &table)
{
  std::string changes;
  if (!from_command_line(table))
    add_changes(table, changes);
  return changes.empty() ? "" : ": with " + changes;
}

std::string place_of_key(const std::string &table_place, const std::string &key)
{
  std::string place = table_place;
  return place.insert(std::min(place.find(": with --set "), place.size()), "." + key);
}

std::string parameter_changes_words(const SceneNode &scene, const std::string &error)
{
  const SceneNode *parameters = scene.find("parameters");
  if (!parameters)
    return "";
  std::string                           values = quoted_parts(error), changes;
  std::vector<const SceneNode::Entry *> others;
  for (const SceneNode::Entry &entry : parameters->entries)
    others.push_back(&entry);
  for (std::size_t i = 0; i < others.size();)
    if (const auto &[name, value] = *others[i]; occurs(name, values))
    {
      values += value.text + ' ';
      if (from_command_line(value) && error.find(value.place.file) == std::string::npos)
        changes += (changes.empty() ? "" : ", ") + value.place.file;
      others.erase(others.begin() + std::ptrdiff_t(i));
      i = 0;
    }
    else
      ++i;
  return changes.empty() ? "" : " (with " + changes + ")";
}

void make_way(SceneNode &older, const SceneNode &newer)
{
  if (older.type != SceneNode::Type::table || newer.type != SceneNode::Type::table)
    return;
  const std::string former = method_in(older, "bdf"), method = method_in(newer, former);
  if (method != former)
    take_away(older, {"order", "beta", "gamma", "theta", "alpha", "rho_inf", "force"});
  if (method != former && method != "bdf" && method != "exact" && older.find("tolerance"))
    take_away(older, {"tolerance", "step"}); // the largest one
  if (newer.find("tolerance") && !older.find("tolerance"))
    take_away(older, {"step", "order"});
}

void make_way_for_start(SceneNode &older, const SceneNode &newer)
{
  if (older.type != SceneNode::Type::table || newer.type != SceneNode::Type::table || !newer.find("rule"))
    return;
  if (newer.find("angles") || newer.find("speeds") || newer.find("driver"))
    take_away(older, {"q", "v"});
  else if (newer.find("q") || newer.find("v"))
    take_away(older, {"angles", "speeds", "driver"});
}

void make_way_for_frame(SceneNode &older_scene, const SceneNode &newer_frame)
{
  SceneNode *frame = older_scene.find("frame");
  if (!frame || frame->type != SceneNode::Type::table || newer_frame.type != SceneNode::Type::table)
    return;
  if (newer_frame.find("reduced") && !frame->find("reduced"))
  {
    take_all_away(*frame);
    if (SceneNode *reduction = older_scene.find("reduction"))
      take_all_away(*reduction);
    auto &entries = older_scene.entries;
    entries.erase(std::remove_if(entries.begin(), entries.end(),
                                 [](const SceneNode::Entry &entry)
                                 { return entry.first == "reduction" && entry.second.entries.empty(); }),
                  entries.end());
  }
  else if (!newer_frame.find("reduced") && (newer_frame.find("cad") || newer_frame.find("stiffness")))
    take_away(*frame, {"reduced"});
}

} // namespace gestell::apps
