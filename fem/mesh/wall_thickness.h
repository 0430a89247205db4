#pragma once

#include "fem/values/mesh.h"

namespace gestell::fem
{

/// How thin the walls of a mesh are, compared with its elements.
struct WallThickness
{
  double thinnest     = 0.; ///< [m] wall, by area the fifth percentile
  double median_ratio = 0.; ///< element size over thickness, the median by area of walls thinner than the elements
  double thin_share   = 0.; ///< of the surface that belongs to such walls
};

/**
 * Measured from the middle of every triangle of the skin inward at right angles until the skin is met again.  The size
 * of an element is the longest side of the triangle.
 */
WallThickness wall_thickness(const Mesh &mesh);

} // namespace gestell::fem
