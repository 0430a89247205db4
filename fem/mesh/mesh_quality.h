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

/// Orthonormal vectors along which a point may move on its surface (or straight edge): none for corners, three inside
/// the body.
using Freedom = std::vector<Vector3>;

/**
 * Moves the points of cells with a quality below `wanted` so that the worst cell around each of them gets better.
 *
 * Each point climbs the worst quality of its cells by steps along its freedom, halved where none is better.  Cells stay
 * positively oriented, so the skin stays the same surface; no cell around a moved point gets worse than the worst one
 * was before.  Delaunay meshes of plates contain a few slivers with nearly all points on the skin, which gmsh cannot
 * improve because it moves inner points only.
 *
 * @param freedom  of each point
 */
void improve_quality(Mesh &mesh, const std::vector<Freedom> &freedom, double wanted = 0.3);

} // namespace gestell::fem
