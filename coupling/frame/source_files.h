#pragma once

#include <string>
#include <vector>

namespace gestell::coupling
{

/// The files that a frame is made from, in the order in which they are named, each once.
struct SourceFiles
{
  std::vector<std::string> found, missing; ///< missing: as named in the script
  /// Why more than these files may determine the frame: "frame.geo:3: names a file by a computed text"; empty: they
  /// determine it.
  std::string beyond;
};

/// `cad` itself and all files that it names, recursively, relative to their own folders.  Names are found in a gmsh
/// script (.geo, and any file that gmsh runs as a script because its type is unknown) as strings in Include, Merge,
/// MergeWithBoundingBox and ShapeFromFile, and in an Abaqus mesh (.inp) in *INCLUDE and INPUT=.
SourceFiles source_files(const std::string &cad);

} // namespace gestell::coupling
