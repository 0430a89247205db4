#pragma once

#include "fem/values/frame_specification.h"
#include "fem/values/mesh.h"

#include <vector>

namespace gestell::fem
{

/// Six times the volume of the cell [m^3], positive if it is positively oriented.
double six_volumes(const Mesh &mesh, const std::array<int, 4> &cell);

/// 12 (3 V)^(2/3) / (sum of the squared edges): 1 for a regular tetrahedron, 0 for a flat one.
double quality(const Mesh &mesh, const std::array<int, 4> &cell);

/// Orthonormal directions in which a point may move on its surface (or straight edge): none for corners, three inside
/// the body.
using Freedom = std::vector<Vector3>;

/**
 * Moves the points of cells with a quality below `wanted` to improve the worst cell around each of them.
 *
 * Each point moves in steps along its allowed directions that increase the worst quality of its cells; steps are halved
 * if none does.  Cells remain positively oriented, so that the skin remains the same surface; no cell around a moved
 * point becomes worse than the worst one was before.  Delaunay meshes of plates contain a few slivers with nearly all
 * points on the skin, which gmsh cannot improve because it moves only inner points.
 *
 * @param freedom  allowed directions of each point
 */
void improve_quality(Mesh &mesh, const std::vector<Freedom> &freedom, double wanted = 0.3);

} // namespace gestell::fem
