#pragma once

#include "fem/geometry/cad_model.h"

#include <string>

namespace gestell::fem
{

/**
 * Whether the solids of gmsh's mesh are made of tetrahedra alone (or have no cells), not of hexahedra, prisms, or
 * prisms with tetrahedra or hexahedra.
 *
 * @throws std::invalid_argument with the number of cells of each kind for others.
 */
bool only_tetrahedra(const CadModel &model, const std::string &head);

} // namespace gestell::fem
