#pragma once

#include "fem/values/mesh.h"

#include <string>

namespace gestell::fem
{

/// @param meshed  the mesh was read, not generated
/// @param head    "<place>: <file>", prefix of the message
/// @throws std::invalid_argument for a cell that is nearly flat, inverted or degenerate
void require_thick_cells(const Mesh &mesh, bool meshed, const std::string &head);

} // namespace gestell::fem
