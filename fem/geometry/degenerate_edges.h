#pragma once

#include <set>

namespace gestell::fem
{

/**
 * Tags of the edges of the model that is open in gmsh which are a point: the tip of a cone, the pole of a sphere.
 *
 * Such an edge has a line in the parameters of its face and no curve in space; OpenCASCADE marks it as degenerate.  Its
 * length tells nothing: rounding makes 0 or 2e-14 m of it.
 */
std::set<int> degenerate_edges();

} // namespace gestell::fem
