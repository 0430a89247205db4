#pragma once

#include <array>
#include <vector>

namespace gestell::fem
{

struct TriangleSurface
{
  std::vector<std::array<double, 3>> points; ///< [m]
  std::vector<std::array<int, 3>>    triangles;
};

/// Volume [m^3] that a closed surface encloses; negative if its triangles are seen clockwise from outside.
double enclosed_volume(const TriangleSurface &surface);

/// Number of edges that do not belong to exactly two triangles running through them in opposite directions; 0 of a
/// closed surface.
int unmatched_edges(const TriangleSurface &surface);

/**
 * Turns the triangles of one solid's surface so that all of them are seen counter-clockwise from outside: neighbours
 * alike, then the largest shell outwards and all others, which are cavities, inwards.
 *
 * @param surface  closed: every edge has two triangles.
 */
void turn_outwards(TriangleSurface &surface);

} // namespace gestell::fem
