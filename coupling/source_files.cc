#include "coupling/source_files.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>

namespace gestell::coupling
{

namespace
{

std::string text_of(const std::filesystem::path &path)
{
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void collect(const std::filesystem::path &path, bool is_script, SourceFiles &sources)
{
  const std::string file = path.lexically_normal().string();
  if (std::find(sources.found.begin(), sources.found.end(), file) != sources.found.end())
    return; // also where files include each other in a circle
  sources.found.push_back(file);
  if (!is_script)
    return;
  static const std::regex naming(R"re(\b(Include|Merge|ShapeFromFile)\s*\(?\s*"([^"\n]+)")re");
  const std::string       text = text_of(path);
  for (auto found = std::sregex_iterator(text.begin(), text.end(), naming); found != std::sregex_iterator(); ++found)
  {
    const std::filesystem::path target = path.parent_path() / (*found)[2].str();
    std::error_code             error;
    if (std::filesystem::is_regular_file(target, error))
      collect(target, (*found)[1] == "Include" || target.extension() == ".geo", sources);
    else
      sources.missing.push_back((*found)[2]);
  }
}

} // namespace

SourceFiles source_files(const std::string &cad)
{
  SourceFiles sources;
  collect(cad, std::filesystem::path(cad).extension() == ".geo", sources);
  return sources;
}

} // namespace gestell::coupling
