#pragma once

#include "fem/values/mesh.h"

#include <array>

namespace gestell::test
{

/**
 * Box [0, size] of n hexahedra; surfaces "x0", "x1", "y0", "y1", "z0", "z1" are its sides.
 *
 * @param distortion inner points are moved by up to this share of a brick.
 */
fem::Mesh brick_mesh(const std::array<int, 3> &n, const std::array<double, 3> &size, double distortion = 0.);

} // namespace gestell::test
