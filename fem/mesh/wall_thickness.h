#pragma once

#include "fem/values/mesh.h"

namespace gestell::fem
{

/// Wall thickness of a mesh relative to its elements.
struct WallThickness
{
  double thinnest     = 0.; ///< [m] wall, the fifth percentile by area
  double median_ratio = 0.; ///< element size over thickness, the median by area of walls thinner than the elements
  double thin_share   = 0.; ///< share of the surface with such walls
};

/**
 * Measured from the centre of every triangle of the skin inward along the normal to the opposite skin.  The size
 * of an element is the longest side of the triangle.
 */
WallThickness wall_thickness(const Mesh &mesh);

} // namespace gestell::fem
