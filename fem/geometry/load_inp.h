#pragma once

#include "fem/geometry/cad_model.h"
#include "fem/values/cad_source.h"

namespace gestell::fem
{

/// Loads the mesh of an .inp file into gmsh, a volume for every solid.
/// @throws std::invalid_argument as read_inp()
MeshGroups load_inp(CadModel &model, const CadSource &source);

} // namespace gestell::fem
