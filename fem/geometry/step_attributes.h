#pragma once

#include "fem/geometry/cad_file.h"
#include "fem/geometry/face.h"

#include <vector>

namespace gestell::fem
{

/// Configures OpenCASCADE's reader, which gmsh uses, to keep the names of faces (ADVANCED_FACE) of later STEP files.
void name_faces_of_step();

/**
 * Adds layers (by name) and colours ("#ff8000", red green blue) of single faces to the groups of these faces.
 *
 * gmsh delivers neither; OpenCASCADE's XCAF reader does.  Its faces are matched to those of gmsh by an interior point:
 * all pieces of a divided face get its attributes. Colours of whole solids are ignored.
 */
void add_step_attributes(std::vector<Face> &faces, const CadSource &source);

} // namespace gestell::fem
