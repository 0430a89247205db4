#include "coupling/frame/source_files.h"

#include "fem/values/geo_tokens.h"
#include "fem/values/inp_lines.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <stdexcept>

namespace gestell::coupling
{

namespace
{

constexpr std::uintmax_t largest_script = 50000000; // bytes; its words take some fifty times as much

std::string text_of(const std::filesystem::path &path)
{
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Language of the references to other files.
enum class Language
{
  none,
  gmsh,
  abaqus
};

/// Whether gmsh reads a file as data (Common/OpenFile.cpp of 4.8: by extensions in small letters or capitals, else by
/// its first bytes).  It runs all others as scripts.
bool is_data(const std::filesystem::path &path)
{
  static const std::set<std::string> data      = {".BDF", ".BREP", ".BRP",  ".CGNS", ".DAT", ".DIFF",   ".FM",  ".IGES",
                                                  ".IGS", ".MED",  ".MESH", ".MMED", ".NAS", ".NEU",    ".OBJ", ".OFF",
                                                  ".P3D", ".PLY",  ".RLE",  ".RMED", ".SAT", ".STEP",   ".STL", ".STP",
                                                  ".UNV", ".VRML", ".VTK",  ".WRL",  ".X_T", ".XMT_TXT"};
  const std::string                  extension = path.extension().string();
  const bool is_mixed = std::any_of(extension.begin(), extension.end(), [](char c) { return c >= 'a' && c <= 'z'; }) &&
                        std::any_of(extension.begin(), extension.end(), [](char c) { return c >= 'A' && c <= 'Z'; });
  return (!is_mixed && data.count(fem::in_capitals(extension)) > 0) || fem::begins_as_mesh(path.string());
}

/// Language of a file that a script merges.
Language merged_language(const std::filesystem::path &path)
{
  return is_data(path) ? Language::none : Language::gmsh;
}

/// Language of the file of the frame, whose kind is known by its extension.
Language language_of(const std::filesystem::path &path)
{
  return fem::in_capitals(path.extension().string()) == ".INP" ? Language::abaqus : merged_language(path);
}

struct NamedFile
{
  std::string           name; ///< as it is written
  std::filesystem::path target;
  Language              language;
};

/// Whether a token of gmsh's language makes a frame depend on more than the files named in the script.
bool asks_beyond_files(const fem::GeoToken &token)
{
  static const std::set<std::string> words = {"Alias",
                                              "AliasWithOptions",
                                              "Combine",
                                              "Cpu",
                                              "CurrentDir",
                                              "CurrentDirectory",
                                              "Draw",
                                              "FileExists",
                                              "GetEnv",
                                              "GetForced",
                                              "GetForcedStr",
                                              "GetNumber",
                                              "GetString",
                                              "GetStringValue",
                                              "GetValue",
                                              "ListFromFile",
                                              "MPI_Rank",
                                              "MPI_Size",
                                              "Memory",
                                              "OnelabAction",
                                              "OnelabRun",
                                              "Plugin",
                                              "Print",
                                              "Rand",
                                              "Save",
                                              "SetNumber",
                                              "SetString",
                                              "Solver",
                                              "System",
                                              "SystemCall",
                                              "Today",
                                              "TotalMemory",
                                              "NonBlockingSystemCall",
                                              "GmshExecutableName"};
  return token.kind == fem::GeoToken::Kind::word && words.count(token.text) > 0;
}

bool reads_a_file(const fem::GeoToken &token)
{
  static const std::set<std::string> words = {"Include", "Merge", "MergeWithBoundingBox", "ShapeFromFile"};
  return token.kind == fem::GeoToken::Kind::word && words.count(token.text) > 0;
}

/// The file name after the word at i; null if it is computed.
const fem::GeoToken *plain_name(const std::vector<fem::GeoToken> &tokens, std::size_t i)
{
  const bool        bracket = i + 1 < tokens.size() && tokens[i + 1].is("(");
  const std::size_t name    = i + (bracket ? 2 : 1);
  const bool        ends    = name + 1 < tokens.size() && tokens[name + 1].is(bracket ? ")" : ";");
  return ends && tokens[name].kind == fem::GeoToken::Kind::text ? &tokens[name] : nullptr;
}

std::vector<NamedFile> named_in_script(const std::filesystem::path &path, std::string &beyond)
{
  const fem::RefuseLine note = [&](int line, const std::string &what)
  {
    if (beyond.empty())
      beyond = path.filename().string() + ":" + std::to_string(line) + ": " + what;
  };
  std::error_code error;
  if (std::filesystem::file_size(path, error) > largest_script)
  {
    beyond = path.filename().string() + " has more than " + std::to_string(largest_script / 1000000) + " MB";
    return {};
  }
  std::vector<fem::GeoToken> tokens;
  try
  {
    tokens = fem::geo_tokens(text_of(path), [&](int line, const std::string &what)
                             { throw std::invalid_argument(std::to_string(line) + ": " + what); });
  }
  catch (const std::invalid_argument &unread)
  {
    beyond = path.filename().string() + ":" + unread.what();
    return {};
  }
  std::vector<NamedFile> named;
  for (std::size_t i = 0; i < tokens.size(); ++i)
    if (asks_beyond_files(tokens[i]))
      note(tokens[i].line, "contains " + tokens[i].text);
    else if (reads_a_file(tokens[i]))
    {
      if (const fem::GeoToken *name = plain_name(tokens, i))
      {
        const std::filesystem::path target = path.parent_path() / name->text;
        named.push_back({name->text, target, tokens[i].is("Include") ? Language::gmsh : merged_language(target)});
      }
      else
        note(tokens[i].line, tokens[i].text + " names its file by a computed string");
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

/// A file to be examined, unless it has been already.
struct Waiting
{
  std::filesystem::path path;
  Language              language;
};

/// Notes the file and puts those that it names in front of the `waiting`, whose last is the next.
void collect(const Waiting &file, std::set<std::string> &known, std::vector<Waiting> &waiting, SourceFiles &sources)
{
  const std::string path = file.path.lexically_normal().string();
  if (!known.insert(path).second)
    return; // also where files include each other in a circle
  sources.found.push_back(path);
  if (file.language == Language::none)
    return;
  const std::vector<NamedFile> named =
      file.language == Language::gmsh ? named_in_script(file.path, sources.beyond) : named_in_inp(file.path);
  const auto first_named = static_cast<std::ptrdiff_t>(waiting.size());
  for (const auto &[name, target, of_target] : named)
  {
    std::error_code error;
    if (std::filesystem::is_regular_file(target, error))
      waiting.push_back({target, of_target});
    else
      sources.missing.push_back(name);
  }
  std::reverse(waiting.begin() + first_named, waiting.end());
}

} // namespace

SourceFiles source_files(const std::string &cad)
{
  SourceFiles           sources;
  std::set<std::string> known;
  std::vector<Waiting>  waiting = {{cad, language_of(cad)}}; // no recursion: chains may be long
  while (!waiting.empty())
  {
    const Waiting next = std::move(waiting.back());
    waiting.pop_back();
    collect(next, known, waiting, sources);
  }
  return sources;
}

} // namespace gestell::coupling
