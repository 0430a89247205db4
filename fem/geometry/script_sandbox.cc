#include "fem/geometry/script_sandbox.h"

#include "fem/geometry/geo_script.h"
#include "fem/geometry/msh_counts.h"
#include "fem/values/named_file.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace gestell::fem
{

namespace
{

namespace files = std::filesystem;

constexpr const char *way_out = "; the script of a frame may only draw, set sizes, mesh, and read files of its folder. "
                                "Remove the line, or use --trust-scripts if you trust the whole script.";

void require_mesh(const std::string &place, const files::path &file)
{
  if (!begins_as_mesh(file.string()))
    throw std::invalid_argument(
        place + ": " + file.string() +
        " is not a gmsh mesh: it does not begin with \"$MeshFormat\", and gmsh would run it as a "
        "script; save the mesh as .msh, or name a script .geo.");
}

/// Also requires that the counts in the file are right, as check_cad_file() does for the file of a scene.
void require_sound_mesh(const std::string &place, const files::path &file)
{
  require_mesh(place, file);
  if (const std::string defect = defect_of_counts(file.string()); !defect.empty())
    throw std::invalid_argument(place + ": " + file.string() + " " + defect);
}

std::string text_of(const files::path &file)
{
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

bool lies_in(const files::path &file, const files::path &folder)
{
  const auto [end, ignored] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
  return end == folder.end();
}

} // namespace

ScriptSandbox::ScriptSandbox(const CadSource &source, CadFile kind) : place_(source.place), path_(source.path)
{
  if (source.scripts == Scripts::trusted || kind == CadFile::abaqus) // .inp is not read by gmsh
    return;
  const files::path file = files::absolute(source.path);
  home_                  = files::weakly_canonical(file.parent_path());
  if (kind == CadFile::mesh)
    require_mesh(place_, file);
  folder_.emplace();
  path_ = kind == CadFile::geo ? copy_script(file) : link(file);
}

std::string ScriptSandbox::in_own_names(std::string message) const
{
  for (const auto &[original, copy] : copies_)
    for (std::size_t at = message.find(copy); at != std::string::npos; at = message.find(copy, at + original.size()))
      message.replace(at, copy.size(), original);
  return message;
}

/// Extensions in small letters: gmsh takes "frame.Step" for a script.
std::string ScriptSandbox::place_for(const files::path &file)
{
  const files::path folder    = folder_->path() / std::to_string(copies_.size());
  std::string       extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  files::create_directory(folder);
  return copies_[file.string()] = (folder / (file.stem().string() + extension)).string();
}

std::string ScriptSandbox::link(const files::path &file)
{
  const std::string copy = place_for(file);
  files::create_symlink(file, copy);
  return copy;
}

std::string ScriptSandbox::copy_script(const files::path &script)
{
  const RefuseLine refuse = [&](int line, const std::string &what) {
    throw std::invalid_argument(place_ + ": " + script.string() + ":" + std::to_string(line) + ": " + what + way_out);
  };
  constexpr std::size_t deepest_script = 50; // includes: gmsh reads each inside the other
  if (++depth_ > deepest_script)
    refuse(1, "is included more than " + std::to_string(deepest_script) + " levels deep; merge scripts");
  const std::string     copy   = place_for(script); // before the files it names: they may name it in turn
  std::vector<GeoToken> tokens = geo_tokens(text_of(script), refuse);
  for (const std::size_t i : judge_geo(tokens, refuse))
    tokens[i].text = copy_named(tokens[i].text, tokens[i - 1].is("Include"), script, tokens[i].line);
  std::ofstream(copy, std::ios::binary) << geo_text(tokens);
  --depth_;
  return copy;
}

std::string ScriptSandbox::copy_named(const std::string &name, bool included, const files::path &script, int line)
{
  const std::string place = place_ + ": " + script.string() + ":" + std::to_string(line);
  const auto refuse = [&](const std::string &what) { throw std::invalid_argument(place + ": " + what + way_out); };
  if (const std::string reason = why_unreachable(script.parent_path() / name); !reason.empty())
    throw std::invalid_argument(place + ": the file \"" + name + "\" " + reason);
  const files::path file = files::weakly_canonical(script.parent_path() / name);
  if (!lies_in(file, home_))
    refuse("reads \"" + name + "\", which is not in the folder of the script, " + home_.string());
  if (!files::is_regular_file(file))
    refuse("reads \"" + name + "\", but there is no such file");
  if (const auto known = copies_.find(file.string()); known != copies_.end())
    return known->second;
  if (included)
    return copy_script(file);
  const auto kind = kind_of_file(file.string());
  if (!kind || *kind == CadFile::abaqus)
    refuse("reads \"" + name + "\", which is not a .step, .brep, .stl, .msh or .geo file");
  if (*kind == CadFile::mesh)
    require_sound_mesh(place, file);
  return *kind == CadFile::geo ? copy_script(file) : link(file);
}

} // namespace gestell::fem
