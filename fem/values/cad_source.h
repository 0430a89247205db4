#pragma once

#include <string>

namespace gestell::fem
{

/// Whether gmsh scripts may use the whole language: run programs, write files, read any file.
enum class Scripts
{
  harmless, ///< no: they are checked first
  trusted
};

/// A file with the geometry of a frame or a part.
struct CadSource
{
  std::string path;
  double      unit = 0.; ///< length unit of a file without one [m]; 0: from the file
  std::string place;     ///< prefix of messages
  Scripts     scripts = Scripts::harmless;
  double      sew     = 0.; ///< [m] edges of open shells this far apart are joined; 0: none
};

} // namespace gestell::fem
