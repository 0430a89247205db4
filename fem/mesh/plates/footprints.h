#pragma once

#include "fem/mesh/plates/brick_lattice.h"

#include <set>

namespace gestell::fem
{

/// Whether two outlines cross, or come too close for cells between them.
bool touch(const std::vector<Side> &a, const std::vector<Side> &b);

/// Shortest way between the corners of each and the sides of the other [m].
double gap_between(const std::vector<Side> &a, const std::vector<Side> &b);

/**
 * Adds the outlines of other solids' footprints to the holes, filled, so that cells of the plate have sides along them:
 * those with plate all around, of which no two touch.
 *
 * @param contacts  tags of faces that other solids share
 */
void add_footprints(PlateSolids &solids, const std::set<int> &contacts, double unit, double diagonal);

} // namespace gestell::fem
