#pragma once

#include "fem/values/cad_source.h"

#include <optional>
#include <string>

namespace gestell::fem
{

enum class CadFile
{
  step,
  brep,
  geo,      ///< script of gmsh
  mesh,     ///< .msh of gmsh
  abaqus,   ///< .inp, mesh of Abaqus or CalculiX
  triangles ///< .stl, a surface
};

/// By the extension of its name; nothing if such files are not read.
std::optional<CadFile> kind_of_file(const std::string &path);

bool is_step(const std::string &path);

/// Whether files of this kind hold cells, and no geometry.
bool is_mesh(CadFile file);

/**
 * Looks at the file before gmsh does, which reads a STEP file that was cut off without a word.
 *
 * @throws std::invalid_argument if it is missing, no file, empty, of a kind that is not read, a STEP file without its
 *         first or last line (ISO 10303-21: "ISO-10303-21;" and "END-ISO-10303-21;"), with references to entities it
 *         does not hold, or without a unit of length, a BREP file without its head or its end, or if source.unit < 0.
 */
CadFile check_cad_file(const CadSource &source);

} // namespace gestell::fem
