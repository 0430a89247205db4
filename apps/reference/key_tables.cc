#include "apps/reference/key_tables.h"

#include "apps/analysis/analyses.h"
#include "apps/analysis/result_files.h"
#include "apps/output/tables/summary_json.h"
#include "apps/output/text/write_file.h"
#include "apps/reference/declared_tables.h"
#include "apps/reference/json_schema.h"
#include "apps/reference/questions.h"
#include "apps/reference/study_tables.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

/// "joint" of [joint.NAME].
std::string family_of(const DeclaredTable &table)
{
  return table.path.substr(0, table.path.find('.'));
}

bool belongs(const KeyGroup &group, const std::string &family)
{
  return std::find(group.families.begin(), group.families.end(), family) != group.families.end();
}

/// Whether one of the keys has the same row.
bool has_row(const std::vector<Key> &keys, const Key &key)
{
  const Key *other = find_key(keys, key.name);
  return other && other->meaning == key.meaning && default_of(*other) == default_of(key) &&
         taken_by(*other) == taken_by(key);
}

/// "#contact", as links of Markdown go to a title.
std::string anchor(std::string title)
{
  std::transform(title.begin(), title.end(), title.begin(),
                 [](unsigned char c) { return c == ' ' ? '-' : std::tolower(c); });
  return "#" + title;
}

/// Type of the key; a table whose keys are a group of their own is a link to it.
std::string type_cell(const Key &key, const std::string &family)
{
  std::string text = taken_by(key);
  for (const KeyGroup &group : key_groups())
    if (const std::string keys = "table with " + quoted_names(key.keys);
        group.of == key.name && belongs(group, family) && text.find(keys) != std::string::npos)
      text.replace(text.find(keys), keys.size(), "[table](" + anchor(group.title) + ")");
  return text;
}

std::string rows(const std::vector<Key> &keys, const std::string &family = "")
{
  if (keys.empty())
    return "";
  std::string text = "| Key | Description | Type / unit | Default |\n|---|---|---|---|\n";
  for (const Key &key : keys)
    text += "| `" + key.name + "` | " + key.meaning + " | " + type_cell(key, family) + " | " + default_of(key) + " |\n";
  return text + "\n";
}

/// Whether the page has to give the signals: those that all types of a family have are in its text.
bool has_own_signals(const DeclaredTable &table)
{
  const std::vector<DeclaredTable> &all = declared_tables();
  return !table.signals.empty() &&
         std::any_of(all.begin(), all.end(),
                     [&](const DeclaredTable &other)
                     { return family_of(other) == family_of(table) && other.signals != table.signals; });
}

/// Whether a value of one of the keys is a list of rows or tables, or a formula; `gestell help` prints all examples.
bool needs_example(const std::vector<Key> &keys)
{
  return std::any_of(keys.begin(), keys.end(),
                     [](const Key &key) {
                       return key.form == Key::Form::rows || key.form == Key::Form::tables ||
                              key.form == Key::Form::formula;
                     });
}

std::string section(const DeclaredTable &table)
{
  std::string      text = "### " + (table.type.empty() ? table.path : table.type) + "\n\n" + table.does;
  std::string      groups;
  std::vector<Key> own = table.keys;
  for (const KeyGroup &group : key_groups())
  {
    if (!belongs(group, family_of(table)))
      continue;
    const auto shared = std::stable_partition(
        own.begin(), own.end(), [&](const Key &key) { return !(group.of.empty() && has_row(group.keys, key)); });
    if (2 * static_cast<std::size_t>(own.end() - shared) <= group.keys.size()) // a reader would have to look up more
      continue;                                                                // keys than stay in the table
    std::vector<Key> others;
    std::copy_if(group.keys.begin(), group.keys.end(), std::back_inserter(others),
                 [&](const Key &key)
                 { return std::none_of(shared, own.end(), [&](const Key &other) { return other.name == key.name; }); });
    groups += (groups.empty() ? " Keys of [" : ", and of [") + group.title + "](" + anchor(group.title) + ")" +
              (others.empty() ? "" : " except " + quoted_names(others));
    own.erase(shared, own.end());
  }
  own.erase(
      std::remove_if(own.begin(), own.end(), [&](const Key &key) { return !table.type.empty() && key.name == "type"; }),
      own.end());
  text += groups + (groups.empty() ? "" : ".");
  if (has_own_signals(table))
    text += " Signals: " + table.signals + ".";
  text += "\n\n" + rows(own, family_of(table));
  if (!table.examples.empty() && needs_example(table.keys))
    text += "```toml\ntype = \"" + table.type + "\"\n" + table.examples.front() + "```\n\n";
  return text;
}

/// Rows of a table.  Keys that its page explains for another table are only named: of a part those of the frame, of a
/// support given by matrices those of a cut.
std::string own_rows(const DeclaredTable &table)
{
  const bool        is_part = table.path == "frame.part";
  const std::string other   = is_part ? "frame" : table.path == "matrices.support" ? "matrices.cut" : "";
  const auto        found   = std::find_if(declared_tables().begin(), declared_tables().end(),
                                           [&](const DeclaredTable &one) { return one.path == other; });
  if (found == declared_tables().end())
    return rows(table.keys);
  std::vector<Key> own = table.keys;
  const auto       same =
      std::stable_partition(own.begin(), own.end(), [&](const Key &key) { return !has_row(found->keys, key); });
  const std::vector<Key> shared(same, own.end());
  own.erase(same, own.end());
  return rows(own) + "Keys with the same meaning as " + (is_part ? "for a [`[frame]`](frame.md#frame)" : "for a cut") +
         ": " + quoted_names(shared) + ".\n\n";
}

std::string content(const std::filesystem::path &file)
{
  std::ifstream in(file);
  if (!in)
    throw std::invalid_argument("there is no document " + file.string());
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

} // namespace

std::string key_tables(const std::string &topic)
{
  std::string text;
  for (const KeyGroup &group : key_groups())
    if (group.families.front() == topic)
      text += "### " + group.title + "\n\n" + (group.of.empty() ? "" : "Keys of `" + group.of + "`.\n\n") +
              rows(group.keys, topic);
  for (const DeclaredTable &table : declared_tables())
    if (table.heading == "[" + topic + ".NAME]" && (!table.type.empty() || table.path == "element"))
      text += section(table);
  if (!text.empty())
    return text;
  for (const DeclaredTable &table : told_tables())
    if (table.path == topic)
      return own_rows(table);
  throw std::invalid_argument("there is no table '" + topic + "' whose keys could be listed");
}

namespace
{

/// Text generated for a marker: "keys: run", "result files"; none for other remarks.
std::string generated(const std::string &marker)
{
  const std::string keys = "keys: ";
  if (marker == "result files")
    return result_files_table();
  if (marker == "members: summary.json")
    return "| Member | Type | Unit | Description |\n|---|---|---|---|\n" + summary_members(result_of_all_kinds());
  if (marker == "questions")
    return question_table();
  if (marker.rfind(keys, 0) != 0)
    throw std::invalid_argument("the marker '" + marker +
                                "' is not known; valid: 'keys: TABLE', 'members: summary.json', 'questions', "
                                "'result files' and 'options'");
  return key_tables(marker.substr(keys.size()));
}

} // namespace

std::string renewed(const std::string &document, const std::string &options)
{
  const std::string begin = "<!-- ", closed = " -->\n", end = "<!-- end -->";
  std::string       text;
  std::size_t       done = 0;
  for (auto from = document.find(begin); from != std::string::npos; from = document.find(begin, done))
  {
    const auto name = from + begin.size(), head = document.find(closed, name), tail = document.find(end, name);
    if (head == std::string::npos || tail == std::string::npos)
      throw std::invalid_argument("a marker '" + begin + "' has no end");
    const std::string marker = document.substr(name, head - name);
    const auto        body   = head + closed.size();
    text += document.substr(done, body - done);
    text += marker != "options" ? generated(marker) : options.empty() ? document.substr(body, tail - body) : options;
    text += end;
    done = tail + end.size();
  }
  return text + document.substr(done);
}

void renew_reference(const std::string &docs, const std::string &options)
{
  const std::filesystem::path folder = docs;
  if (!std::filesystem::is_directory(folder / "reference"))
    throw std::invalid_argument("--renew: " + docs + " has no folder reference; name the folder docs of the sources");
  for (const auto &entry : std::filesystem::recursive_directory_iterator(folder / "reference"))
    if (entry.path().extension() == ".md")
      if (const std::string document = content(entry.path()), now = renewed(document, options); now != document)
        write_file(entry.path().string(), now);
  write_file((folder / "scene.schema.json").string(), json_schema());
  write_file((folder / "summary.schema.json").string(), summary_schema(result_of_all_kinds()));
}

} // namespace gestell::apps
