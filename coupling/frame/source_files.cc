#include "coupling/frame/source_files.h"

#include "fem/values/inp_lines.h"

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

/// In which a file names others.
enum class Language
{
  none,
  gmsh,
  abaqus
};

Language language_of(const std::filesystem::path &path)
{
  const std::string extension = fem::in_capitals(path.extension().string());
  return extension == ".GEO" ? Language::gmsh : extension == ".INP" ? Language::abaqus : Language::none;
}

struct NamedFile
{
  std::string           name; ///< as it is written
  std::filesystem::path target;
  Language              language;
};

std::vector<NamedFile> named_in_script(const std::filesystem::path &path)
{
  static const std::regex naming(R"re(\b(Include|Merge|ShapeFromFile)\s*\(?\s*"([^"\n]+)")re");
  const std::string       text = text_of(path);
  std::vector<NamedFile>  named;
  for (auto found = std::sregex_iterator(text.begin(), text.end(), naming); found != std::sregex_iterator(); ++found)
  {
    const std::filesystem::path target = path.parent_path() / (*found)[2].str();
    named.push_back({(*found)[2], target, (*found)[1] == "Include" ? Language::gmsh : language_of(target)});
  }
  return named;
}

std::vector<NamedFile> named_in_inp(const std::filesystem::path &path)
{
  std::vector<NamedFile> named;
  for (fem::InpLines lines(path.string()); lines.next();)
    if (lines.is_keyword())
    {
      const fem::InpKeyword keyword = lines.keyword();
      if (const std::string target = fem::input_of(keyword, path.string()); !target.empty())
        named.push_back({keyword["INPUT"], target, Language::abaqus});
    }
  return named;
}

void collect(const std::filesystem::path &path, Language language, SourceFiles &sources)
{
  const std::string file = path.lexically_normal().string();
  if (std::find(sources.found.begin(), sources.found.end(), file) != sources.found.end())
    return; // also where files include each other in a circle
  sources.found.push_back(file);
  if (language == Language::none)
    return;
  for (const auto &[name, target, of_target] : language == Language::gmsh ? named_in_script(path) : named_in_inp(path))
  {
    std::error_code error;
    if (std::filesystem::is_regular_file(target, error))
      collect(target, of_target, sources);
    else
      sources.missing.push_back(name);
  }
}

} // namespace

SourceFiles source_files(const std::string &cad)
{
  SourceFiles sources;
  collect(cad, language_of(cad), sources);
  return sources;
}

} // namespace gestell::coupling
