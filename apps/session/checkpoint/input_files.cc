#include "apps/session/checkpoint/input_files.h"

#include "apps/scene/file/scene_file.h"
#include "coupling/frame/source_files.h"

#include <set>

namespace gestell::apps
{
namespace
{

namespace fs = std::filesystem;

void add(const SceneNode &node, std::set<fs::path> &files)
{
  std::error_code error;
  const fs::path  named = fs::path(node.folder) / node.text;
  files.insert(node.place.file);
  if (node.type == SceneNode::Type::text && !node.text.empty() && fs::is_regular_file(named, error))
    for (const std::string &source : coupling::source_files(named.string()).found)
      files.insert(source);
  for (const auto &[key, value] : node.entries)
    add(value, files);
  for (const SceneNode &element : node.elements)
    add(element, files);
}

} // namespace

std::vector<fs::path> input_files(const std::string &file, const std::vector<std::string> &overrides)
{
  std::set<fs::path> files = {file};
  try
  {
    add(read_scene_file(file, overrides), files);
  }
  catch (const std::invalid_argument &) // the reader of the scene reports the reason
  {
  }
  return {files.begin(), files.end()};
}

} // namespace gestell::apps
