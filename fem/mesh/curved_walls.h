#pragma once

#include <map>

namespace gestell::fem
{

/// Largest size of the triangles on faces, by tag, in gmsh's unit.
using FaceSizes = std::map<int, double>;

/**
 * Curved faces of gmsh's surface mesh whose triangles would cut through a thin wall, with the sizes that they need.
 *
 * A side of length l leaves a face of radius R by delta = l^2/(8 R), a triangle by up to 4/3 of that (equilateral), to
 * the side of the centre. There a face at the distance d, across the wall or a gap, leaves its own surface in the same
 * direction or is plane, so that triangles cannot meet while 4/3 delta < d. A face is listed if delta > 2/3 d; rounded
 * edges of hollow sections, 0.59 d over 90 degrees for a radius of twice the wall, are not. The size of both faces of
 * the wall is that of delta = d/4,
 *
 *     l sqrt(d/(4 delta)) = sqrt(2 R d),
 *
 * and not below 1/200 of the circumference, which a wall would ask for that runs out to nothing.
 */
FaceSizes faces_that_cut_walls();

/// The same sizes sqrt(2 R d) of all curved faces where they are below `size`, for surfaces that gmsh cannot mesh.
/// @param size  [gmsh's unit]
FaceSizes sizes_by_walls(double size);

} // namespace gestell::fem
