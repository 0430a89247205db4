#pragma once

#include "fem/mesh/plates/sheets.h"

#include <string>

namespace gestell::fem
{

/// "plates are swept: 29 walls, 10 to 16 mm thick, make 94 % of the volume; 230 bricks ...": a wall is a sheet with a
/// width of at least three times its thickness.
std::string wall_statement(const BrickLattice &lattice, const Sheets &sheets);

} // namespace gestell::fem
