#pragma once

#include <string>
#include <vector>

namespace gestell::coupling
{

/// The files a frame is made from, in the order they are named, each once.
struct SourceFiles
{
  std::vector<std::string> found, missing; ///< missing: as the script writes them
};

/// `cad` itself and, of a script of gmsh (.geo), all that it names as text in Include, Merge and ShapeFromFile, and
/// that these name: relative to their own folder, as gmsh reads it.
SourceFiles source_files(const std::string &cad);

} // namespace gestell::coupling
