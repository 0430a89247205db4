#pragma once

#include <string>
#include <vector>

namespace gestell::coupling
{

/// The files a frame is made from, in the order they are named, each once.
struct SourceFiles
{
  std::vector<std::string> found, missing; ///< missing: as the script writes them
  /// Why more than these files may decide what the frame is: "frame.geo:3: names a file by a computed text"; empty: no
  /// more does.
  std::string beyond;
};

/// `cad` itself and all that it names, and that these name, relative to their own folders: of a script of gmsh (.geo,
/// and whatever gmsh does not know as data and so runs as one) as text in Include, Merge, MergeWithBoundingBox and
/// ShapeFromFile, of a mesh of Abaqus (.inp) in *INCLUDE and INPUT=.
SourceFiles source_files(const std::string &cad);

} // namespace gestell::coupling
