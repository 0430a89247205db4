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
 * What gmsh may open in place of a CAD file, in a folder of its own as long as this lives.
 *
 * gmsh runs as a script what it does not know, whatever its extension, and the file "NAME.opt" beside each file that it
 * reads.  So a script (.geo) is judged, see judge_geo(), and copied as it was judged, with those that it includes;
 * other files are linked alone.  A .msh must begin as one.  A script names files in its own folder and those below it
 * only.
 */
class ScriptSandbox
{
public:
  /// @throws std::invalid_argument with file and line; of source.scripts == Scripts::trusted nothing is judged.
  ScriptSandbox(const CadSource &source, CadFile kind);

  /// To be opened by gmsh.
  const std::string &path() const { return path_; }

  /// A message of gmsh with the files as their owner calls them.
  std::string in_own_names(std::string message) const;

private:
  std::string place_for(const std::filesystem::path &file);
  std::string link(const std::filesystem::path &file);
  std::string copy_script(const std::filesystem::path &script);
  std::string copy_named(const std::string &name, bool included, const std::filesystem::path &script, int line);

  std::string                        place_;  ///< heads messages
  std::filesystem::path              home_;   ///< folder of the script
  std::optional<TemporaryDirectory>  folder_; ///< none: the file is opened as it is
  std::string                        path_;
  std::size_t                        depth_ = 0; ///< of the scripts that include each other
  std::map<std::string, std::string> copies_;    ///< by the path of the original
};

} // namespace gestell::fem
