#pragma once

#include "fem/mesh/plates/brick_lattice.h"

namespace gestell::fem
{

/**
 * Creates a lattice in which the bricks around every hole form a separate region: a box around the hole that extends
 * into the plate by three quarters of its half width, or less if there is less space.  Footprints without space get
 * none.
 *
 * @throws NotSwept if there is no plate around a hole, or something is on the plate directly next to it.
 */
BrickLattice lattice_with_regions(const PlateSolids &solids, double diagonal);

} // namespace gestell::fem
