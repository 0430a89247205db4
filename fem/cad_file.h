#pragma once

#include "fem/frame_specification.h"

#include <string>

namespace gestell::fem
{

enum class CadFile
{
  step,
  brep,
  geo, ///< script of gmsh
  mesh ///< .msh of gmsh
};

bool is_step(const std::string &path);

/**
 * Looks at the file before gmsh does, which reads a STEP file that was cut off without a word.
 *
 * @throws std::invalid_argument if it is missing, no file, empty, of a kind that is not read, a STEP file without its
 *         first or last line (ISO 10303-21: "ISO-10303-21;" and "END-ISO-10303-21;"), a BREP file without its head or
 *         its end, or if specification.unit < 0.
 */
CadFile check_cad_file(const FrameSpecification &specification);

} // namespace gestell::fem
