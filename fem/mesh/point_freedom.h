#pragma once

#include "fem/geometry/cad_model.h"
#include "fem/mesh/mesh_quality.h"

#include <cstddef>
#include <vector>

namespace gestell::fem
{

/// Allowed directions of the points of gmsh's mesh: three inside a solid, two on an outer plane, one on a straight edge
/// between faces, none on corners and on curved or inner surfaces.
std::vector<Freedom> point_freedom(const CadModel &model, const std::vector<std::size_t> &node);

} // namespace gestell::fem
