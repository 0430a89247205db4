#pragma once

#include <Eigen/Core>

#include <array>
#include <vector>

namespace gestell::fem
{

struct TriangleSurface
{
  std::vector<std::array<double, 3>> points; ///< [m]
  std::vector<std::array<int, 3>>    triangles;
};

/// Volume [m^3] enclosed by a closed surface; negative if its triangles are clockwise as seen from outside.
double enclosed_volume(const TriangleSurface &surface);

/// Number of edges that do not belong to exactly two triangles with opposite directions; 0 for a closed surface.
int unmatched_edges(const TriangleSurface &surface);

/**
 * Orients the triangles of one solid's surface counter-clockwise as seen from outside: adjacent triangles consistently,
 * then the largest shell outwards and all others, which are cavities, inwards.
 *
 * @param surface  closed: every edge has two triangles.
 */
void turn_outwards(TriangleSurface &surface);

/// The point of a triangle with area that is nearest to x.
Eigen::Vector3d nearest_on_triangle(const Eigen::Vector3d &x, const std::array<Eigen::Vector3d, 3> &corners);

} // namespace gestell::fem
