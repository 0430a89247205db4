#pragma once

#include "fem/mesh/plates/brick_lattice.h"

namespace gestell::fem
{

/**
 * Makes a lattice whose bricks around every hole are a region of their own: a box about the hole that reaches into the
 * plate around it by three quarters of its half width, or less where there is less room.
 *
 * @throws NotSwept where a hole leaves no plate around it, or something stands on the plate right beside it.
 */
BrickLattice lattice_with_regions(const PlateSolids &solids, double diagonal);

} // namespace gestell::fem
