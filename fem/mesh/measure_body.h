#pragma once

#include "fem/values/cad_body.h"
#include "fem/values/cad_source.h"

namespace gestell::fem
{

/**
 * Volume, centre and inertia of the solids in a .step, .stp, .brep, .geo, .msh or .stl file.
 *
 * Of CAD by OpenCASCADE's integrals over the faces, of tetrahedra and of closed triangles by exact sums; the unit is as
 * in open_cad(), for a .stl it must be given.
 *
 * gmsh works in a child process, see in_child().
 *
 * @throws std::invalid_argument as open_cad(), if a surface of triangles is open or solids overlap, if the child dies.
 */
CadBody measure_part(const CadSource &source);

} // namespace gestell::fem
