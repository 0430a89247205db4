#pragma once

#include "fem/geometry/cad_file.h"
#include "fem/values/temporary_directory.h"

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace gestell::fem
{

/**
 * A safe copy of a CAD file for gmsh, in a separate folder during its lifetime. gmsh runs unknown files as scripts,
 * whatever their extension, and the file "NAME.opt" next to each file that it reads. So a script (.geo) is checked, see
 * judge_geo(), and its checked text copied, with the scripts that it includes; other files are linked individually.  A
 * .msh must begin as one.  A script names files in its own folder and those below it only.
 */
class ScriptSandbox
{
public:
  /// @throws std::invalid_argument with file and line; with source.scripts == Scripts::trusted nothing is checked.
  ScriptSandbox(const CadSource &source, CadFile kind);

  /// Path for gmsh.
  const std::string &path() const { return path_; }

  /// A message of gmsh with the original names of the files.
  std::string in_own_names(std::string message) const;

private:
  std::string place_for(const std::filesystem::path &file);
  std::string link(const std::filesystem::path &file);
  std::string copy_script(const std::filesystem::path &script);
  std::string copy_named(const std::string &name, bool included, const std::filesystem::path &script, int line);

  std::string                        place_;  ///< prefix of messages
  std::filesystem::path              home_;   ///< folder of the script
  std::optional<TemporaryDirectory>  folder_; ///< none: the file is opened directly
  std::string                        path_;
  std::size_t                        depth_ = 0; ///< of the scripts that include each other
  std::map<std::string, std::string> copies_;    ///< by the original path
};

} // namespace gestell::fem
