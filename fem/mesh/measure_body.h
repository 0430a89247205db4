#pragma once

#include "fem/values/cad_body.h"
#include "fem/values/cad_source.h"

namespace gestell::fem
{

/**
 * Volume, centre and inertia of the solids in a .step, .stp, .brep, .geo, .msh or .stl file.
 *
 * CAD is integrated by OpenCASCADE over the faces, tetrahedra and closed triangle surfaces by exact sums; the unit is
 * that of open_cad(), for a .stl it must be given.
 *
 * gmsh runs in a child process, see in_child().
 *
 * @throws std::invalid_argument as open_cad() does, if triangles are open, solids overlap or the child dies.
 */
CadBody measure_part(const CadSource &source);

} // namespace gestell::fem
