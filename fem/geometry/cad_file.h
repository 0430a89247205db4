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

/// Kind of the file by its extension; empty if such files are not supported.
std::optional<CadFile> kind_of_file(const std::string &path);

bool is_step(const std::string &path);

/// Whether files of this kind contain cells instead of geometry.
bool is_mesh(CadFile file);

/**
 * Checks the file before gmsh, which reads a truncated STEP file without an error.
 *
 * @throws std::invalid_argument if it is missing, no file, empty, of a kind that is not read, a STEP file without its
 *         first or last line (ISO 10303-21: "ISO-10303-21;" and "END-ISO-10303-21;"), with references to missing
 * entities, or without a unit of length, a BREP file without its header or its end, or if source.unit < 0.
 */
CadFile check_cad_file(const CadSource &source);

} // namespace gestell::fem
