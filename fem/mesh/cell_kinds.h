#pragma once

#include "fem/geometry/cad_model.h"

#include <string>

namespace gestell::fem
{

enum class CellKind
{
  tetrahedra,
  hexahedra
};

/**
 * What the solids of gmsh's mesh are made of; tetrahedra if they have no cells.
 *
 * @throws std::invalid_argument with the number of cells of each kind if there are several, or others.
 */
CellKind kind_of_cells(const CadModel &model, const std::string &head);

} // namespace gestell::fem
