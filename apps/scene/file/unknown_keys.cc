#include "apps/scene/file/unknown_keys.h"

#include "apps/scene/file/written_text.h"
#include "fem/values/nearest_name.h"

namespace gestell::apps
{
namespace
{

std::invalid_argument unknown(const SceneNode::Entry &entry, const std::string &path,
                              const std::vector<std::string> &known)
{
  const auto &[key, value] = entry;
  return std::invalid_argument(value.place.text() + ": " + (path.empty() ? "" : path + ": ") + "unknown key '" + key +
                               "'" + suggestion(key, known));
}

} // namespace

void refuse_unknown(const SceneNode &table, const std::string &path)
{
  for (const auto &[key, value] : table.entries)
  {
    if (!value.used)
      throw unknown({key, value}, path, {table.requested.begin(), table.requested.end()});
    // Only tables whose keys a reader requested are searched for unknown keys.
    const std::string own = (path.empty() ? "" : path + ".") + written_key(key);
    if (value.type == SceneNode::Type::table && (!value.requested.empty() || value.entries.empty()))
      refuse_unknown(value, own);
    for (std::size_t i = 0; i < value.elements.size(); ++i)
      if (!value.elements[i].requested.empty())
        refuse_unknown(value.elements[i], own + "[" + std::to_string(i + 1) + "]");
  }
}

std::optional<std::invalid_argument> unknown_key(const SceneNode &table, const std::vector<Key> &declared,
                                                 const std::string &path)
{
  std::vector<std::string> absent; // one of them may be intended
  for (const Key &key : declared)
    if (!table.find(key.name))
      absent.push_back(key.name);
  for (const SceneNode::Entry &entry : table.entries)
    if (!entry.second.used && !find_key(declared, entry.first))
      return unknown(entry, path, absent);
  return {};
}

} // namespace gestell::apps
