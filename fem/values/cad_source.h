#pragma once

#include <string>

namespace gestell::fem
{

/// Whether scripts of gmsh may do all that its language allows: run programs, write files, read any.
enum class Scripts
{
  harmless, ///< no: they are judged first
  trusted
};

/// A file with the geometry of a frame or a part.
struct CadSource
{
  std::string path;
  double      unit = 0.; ///< length unit of a file without one [m]; 0: the file knows
  std::string place;     ///< heads messages
  Scripts     scripts = Scripts::harmless;
};

} // namespace gestell::fem
