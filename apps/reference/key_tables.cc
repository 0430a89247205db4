#include "apps/reference/key_tables.h"

#include "apps/reference/declared_tables.h"

#include <algorithm>

namespace gestell::apps
{
namespace
{

std::string rows(const std::vector<Key> &keys)
{
  if (keys.empty())
    return "";
  std::string text = "| key | | takes | default |\n|---|---|---|---|\n";
  for (const Key &key : keys)
    text += "| `" + key.name + "` | " + key.meaning + " | " + taken_by(key) + " | " + default_of(key) + " |\n";
  return text + "\n";
}

bool is_shared(const Key &key, const KeyGroup &group)
{
  const Key *shared = find_key(group.keys, key.name);
  return shared && shared->meaning == key.meaning;
}

/// "#contact", as links of Markdown go to a title.
std::string anchor(std::string title)
{
  std::transform(title.begin(), title.end(), title.begin(),
                 [](unsigned char c) { return c == ' ' ? '-' : std::tolower(c); });
  return "#" + title;
}

std::string section(const DeclaredTable &table)
{
  const std::string type = table.path.substr(table.path.find('.') + 1);
  std::string       text = "### " + type + "\n\n" + table.does;
  std::vector<Key>  own  = table.keys;
  for (const KeyGroup &group : key_groups())
  {
    const auto shared =
        std::stable_partition(own.begin(), own.end(), [&](const Key &key) { return !is_shared(key, group); });
    if (shared == own.end())
      continue;
    own.erase(shared, own.end());
    text += " Keys of [" + group.title + "](" + anchor(group.title) + ").";
  }
  text += "\n\n" + rows(own);
  if (!table.signals.empty())
    text += "Signals: " + table.signals + ".\n\n";
  for (const std::string &example : table.examples)
    text += "```toml\ntype = \"" + type + "\"\n" + example + "```\n\n";
  return text;
}

} // namespace

std::string key_tables()
{
  std::string text;
  for (const KeyGroup &group : key_groups())
    text += "### " + group.title + "\n\n" + rows(group.keys);
  for (const DeclaredTable &table : declared_tables())
    text += section(table);
  return text;
}

} // namespace gestell::apps
