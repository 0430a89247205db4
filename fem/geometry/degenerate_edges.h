#pragma once

#include <set>

namespace gestell::fem
{

/**
 * Tags of the degenerate edges of the model open in gmsh; these are points: the tip of a cone, the pole of a sphere.
 *
 * Such an edge has a line in the parameters of its face and no curve in space; OpenCASCADE marks it as degenerate.  Its
 * length is rounding (0 or 2e-14 m).
 */
std::set<int> degenerate_edges();

} // namespace gestell::fem
