#include "apps/reference/help_text.h"

#include "apps/reference/questions.h"
#include "apps/reference/study_tables.h"
#include "apps/reference/synonyms.h"
#include "fem/values/nearest_name.h"

#include <regex>
#include <set>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

std::string padded(const std::string &name)
{
  constexpr std::size_t name_width = 24; // of the 80 letters of a line; longer names are followed by one blank
  return "  " + name + std::string(name.size() < name_width ? name_width - name.size() : 1, ' ');
}

/// Without what Markdown needs: "see [geometry](#geometry)".
std::string plain(const std::string &text)
{
  static const std::regex link(R"(\[([^\]]+)\]\([^)]+\))");
  return std::regex_replace(text, link, "$1");
}

std::string key_text(const Key &key, const std::string &before = "")
{
  const std::string own  = default_of(key);
  std::string       text = padded(before + key.name) + plain(key.meaning) + ": " + taken_by(key) +
                     (own.empty()         ? ""
                      : own == "required" ? "; required"
                                          : "; default " + plain(own)) +
                     "\n";
  for (const Key &inner : key.keys)
    text += key_text(inner, before + "  ");
  return text;
}

std::string table_text(const DeclaredTable &table)
{
  std::string text =
      table.heading + (table.type.empty() ? "" : ", type = \"" + table.type + "\"") + ": " + plain(table.does) + "\n\n";
  for (const Key &key : table.keys)
    text += key_text(key);
  if (!table.signals.empty())
    text += "\nSignals: " + table.signals + "\n";
  for (const std::string &example : table.examples)
    text += "\n" + table.heading + "\ntype = \"" + table.type + "\"\n" + example;
  return text;
}

std::string list_of_tables()
{
  std::string text = "Commands by question; gestell COMMAND --help lists their options.\n\n" + question_lines() +
                     "\nTables of scenes and studies; gestell help TABLE lists their keys.\n\n";
  for (const DeclaredTable &table : told_tables())
    text += padded(table.path) + plain(table.does) + "\n";
  return text;
}

/// The types of a table that has some, "joint".
std::string types_of(const std::string &family)
{
  std::string text;
  for (const DeclaredTable &table : told_tables())
    if (table.path.rfind(family + ".", 0) == 0)
      text += padded(table.path) + plain(table.does) + "\n";
  return text;
}

std::string last_part(const std::string &path)
{
  return path.substr(path.rfind('.') + 1);
}

/// A key with its place in the scene, "frame.damping.ratio"; keys of inner tables, too.
struct ToldKey
{
  std::string path;
  const Key  *key;
};

void add_keys(const std::string &above, const std::vector<Key> &keys, std::set<std::string> &known,
              std::vector<ToldKey> &told)
{
  for (const Key &key : keys)
  {
    const std::string path = above + "." + key.name;
    if (known.insert(path).second) // some inner tables are declared as tables, too
      told.push_back({path, &key});
    add_keys(path, key.keys, known, told);
  }
}

const std::vector<ToldKey> &told_keys()
{
  static const std::vector<ToldKey> all = []
  {
    std::vector<ToldKey>  told;
    std::set<std::string> known;
    for (const DeclaredTable &table : told_tables())
      add_keys(table.path, table.keys, known, told);
    return told;
  }();
  return all;
}

/// Whether `topic` is the path or its last parts.
bool ends_in(const std::string &path, const std::string &topic)
{
  const std::string last = "." + topic;
  return path == topic ||
         (path.size() > last.size() && path.compare(path.size() - last.size(), std::string::npos, last) == 0);
}

std::string keys_called(const std::string &topic)
{
  std::string text;
  for (const ToldKey &told : told_keys())
    if (ends_in(told.path, topic))
      text += told.path.substr(0, told.path.rfind('.')) + "\n" + key_text(*told.key);
  return text;
}

/// A line for each key with the name of a table.
std::string keys_beside(const DeclaredTable &table, const std::string &topic)
{
  std::string text;
  for (const ToldKey &told : told_keys())
    if (told.path != table.path && told.path != "scene." + table.path && ends_in(told.path, topic))
      text += padded(told.path) + plain(told.key->meaning) + "\n";
  return text.empty() ? "" : "\nKeys of this name; gestell help KEY describes them.\n\n" + text;
}

/// The tables, or the keys, of that very name; empty: there are none.
std::string under_name(const std::string &topic)
{
  for (const DeclaredTable &table : told_tables())
    if (topic == table.path)
    {
      const std::string types = types_of(topic);
      return table_text(table) + (types.empty() ? "" : "\n" + types) + keys_beside(table, topic);
    }
  if (const std::string types = types_of(topic); !types.empty())
    return types;
  for (const DeclaredTable &table : told_tables())
    if (topic == last_part(table.path))
      return table_text(table) + keys_beside(table, topic);
  return keys_called(topic);
}

/// Tables that describe what is called `topic` in the workshop.
std::string under_synonym(const std::string &topic)
{
  std::string text;
  for (const Synonym &synonym : synonyms())
    if (topic == synonym.word)
      for (const std::string &path : synonym.tables)
        for (const DeclaredTable &table : told_tables())
          if (path == table.path)
            text += padded(table.path) + plain(table.does) + "\n";
  return text;
}

std::invalid_argument unknown(const std::string &topic)
{
  std::set<std::string> names;
  for (const DeclaredTable &table : told_tables())
  {
    names.insert(table.path);
    names.insert(last_part(table.path));
  }
  for (const ToldKey &told : told_keys())
  {
    std::size_t begin = 0;
    do
    {
      names.insert(told.path.substr(begin));
      begin = told.path.find('.', begin) + 1;
    } while (begin > 0);
  }
  for (const Synonym &synonym : synonyms())
    names.insert(synonym.word);
  return std::invalid_argument("help: there is no table or key '" + topic + "'" +
                               suggestion(topic, {names.begin(), names.end()}));
}

} // namespace

std::string help_text(const std::string &topic)
{
  if (topic.empty())
    return list_of_tables();
  const std::string named = under_name(topic), related = under_synonym(topic);
  if (named.empty() && related.empty())
    if (const std::string answers = question_lines(topic); !answers.empty())
      return answers;
  if (named.empty() && related.empty())
    throw unknown(topic);
  return named + (named.empty() || related.empty() ? "" : "\n") +
         (related.empty() ? "" : "Tables for '" + topic + "'; gestell help TABLE lists their keys.\n\n" + related);
}

} // namespace gestell::apps
