#include "apps/study/runs/study_record.h"

#include "apps/output/text/json.h"
#include "apps/output/text/write_file.h"

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

SceneNode without_words(const SceneNode &root)
{
  SceneNode node = root;
  node.entries.erase(std::remove_if(node.entries.begin(), node.entries.end(),
                                    [](const SceneNode::Entry &entry) { return !matters(entry.first); }),
                     node.entries.end());
  return node;
}

} // namespace

StudyRecord record_of(const StudyFile &study, const SceneVariants &variants, int n_runs, const std::string &frame_key)
{
  StudyRecord record{study.name, n_runs, {}, {}};
  flatten(without_words(study.root), "", record.entries);
  flatten(without_words(variants.root()), "scene", record.entries);
  if (!frame_key.empty())
    record.entries["content of the frame's files"] = frame_key;
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
    return StudyRecord{json.at("study"), json.at("runs"), json.at("entries").get<Entries>(),
                       json.value("units", std::vector<std::string>())};
  }
  catch (const nlohmann::json::exception &)
  {
    throw std::invalid_argument(file.string() + ": is no record of a study; remove it with the rows beside it, or give "
                                                "another folder with -o");
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
      texts.push_back(key + " was " + value + ", is gone");
  return texts;
}

} // namespace gestell::apps
