#include "apps/study/runs/study_record.h"

#include "apps/output/text/json.h"
#include "apps/output/text/write_file.h"
#include "coupling/frame/sha256.h"
#include "coupling/frame/source_files.h"

#include <algorithm>
#include <fstream>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

using Entries = std::map<std::string, std::string>;

std::string scalar_text(const SceneNode &node)
{
  if (node.type == SceneNode::Type::boolean)
    return node.boolean ? "true" : "false";
  return node.type == SceneNode::Type::text ? '"' + node.text + '"' : node.text;
}

void flatten(const SceneNode &node, const std::string &path, Entries &entries)
{
  for (const auto &[key, value] : node.entries)
    flatten(value, (path.empty() ? "" : path + '.') + written_key(key), entries);
  for (std::size_t i = 0; i < node.elements.size(); ++i)
    flatten(node.elements[i], path + '[' + std::to_string(i + 1) + ']', entries);
  if (node.type != SceneNode::Type::table && node.type != SceneNode::Type::array)
    entries[path] = scalar_text(node);
}

/// Entries that say nothing about the numbers of a row.
bool matters(const std::string &key)
{
  static const std::vector<std::string> others{"name",     "description", "extends", "surface",
                                               "optimise", "choose",      "keep",    "scene"};
  return std::find(others.begin(), others.end(), key) == others.end();
}

template <typename Leaves>
void leave_out(SceneNode &table, const Leaves &leaves)
{
  table.entries.erase(std::remove_if(table.entries.begin(), table.entries.end(),
                                     [&](const SceneNode::Entry &entry) { return leaves(entry.first); }),
                      table.entries.end());
}

SceneNode without_words(const SceneNode &root)
{
  SceneNode node = root;
  leave_out(node, [](const std::string &key) { return !matters(key); });
  if (SceneNode *variables = node.find("variables"))
    for (auto &[name, variable] : variables->entries)
      leave_out(variable, [](const std::string &key) { return key == "scatter" || key == "width"; });
  return node;
}

/// Content of every file that a text in the node names.
void add_contents(const SceneNode &node, Entries &entries)
{
  for (const auto &[key, value] : node.entries)
    add_contents(value, entries);
  for (const SceneNode &element : node.elements)
    add_contents(element, entries);
  std::error_code             none;
  const std::filesystem::path file = std::filesystem::path(node.folder) / node.text;
  if (node.type != SceneNode::Type::text || node.text.empty() || !std::filesystem::is_regular_file(file, none))
    return;
  for (const std::string &source : coupling::source_files(file.string()).found)
    entries["content of " + std::filesystem::proximate(source, node.folder).generic_string()] =
        coupling::sha256_of_file(source);
}

} // namespace

StudyRecord record_of(const StudyFile &study, const SceneVariants &variants, int n_runs)
{
  StudyRecord record{study.name, n_runs, {}, {}};
  flatten(without_words(study.root), "", record.entries);
  flatten(without_words(variants.root()), "scene", record.entries);
  add_contents(variants.root(), record.entries);
  for (const VariableRequest &request : study.variables)
  {
    for (const SceneNode &choice : request.choices)
      add_contents(choice, record.entries);
    std::vector<std::string> words = request.choices.empty() ? request.variable.words : std::vector<std::string>();
    for (const auto &[value, file] : request.files)
      words.push_back(file);
    for (const std::string &word : words)
    {
      SceneNode node;
      node.type   = SceneNode::Type::text;
      node.text   = word;
      node.folder = request.folder;
      add_contents(node, record.entries);
    }
  }
  return record;
}

std::optional<StudyRecord> read_record(const std::filesystem::path &file)
{
  std::ifstream in(file);
  if (!in)
    return std::nullopt;
  try
  {
    const Json json = Json::parse(in);
    if (!json.at("runs").is_number_integer()) // else the conversion of a real one is undefined
      throw Json::other_error::create(501, "runs is not an integer", &json);
    return StudyRecord{json.at("study"), json.at("runs"), json.at("entries").get<Entries>(),
                       json.value("units", std::vector<std::string>())};
  }
  catch (const nlohmann::json::exception &)
  {
    throw std::invalid_argument(
        file.string() +
        ": is not a record of a study; remove it together with its rows, or name another folder with -o");
  }
}

void write_record(const std::filesystem::path &file, const StudyRecord &record)
{
  Json json;
  json["study"]   = record.study;
  json["runs"]    = record.n_runs;
  json["units"]   = record.units;
  json["entries"] = record.entries;
  write_file(file, json.dump(1) + '\n');
}

std::vector<std::string> differences(const StudyRecord &before, const StudyRecord &now)
{
  std::vector<std::string> texts;
  for (const auto &[key, value] : now.entries)
  {
    const auto old = before.entries.find(key);
    if (old == before.entries.end())
      texts.push_back(key + " = " + value + " is new");
    else if (old->second != value)
      texts.push_back(key + " was " + old->second + ", is " + value);
  }
  for (const auto &[key, value] : before.entries)
    if (!now.entries.count(key))
      texts.push_back(key + " was " + value + ", is removed");
  return texts;
}

} // namespace gestell::apps
