#pragma once

#include "fem/values/mesh.h"

#include <array>
#include <functional>
#include <optional>

namespace gestell::test
{

/// What a brick (i, j, k) of a box is filled with, if with anything.
using Filling = std::function<std::optional<fem::CellKind>(int i, int j, int k)>;

/**
 * Box [0, size] of n bricks, each a hexahedron, two prisms along z or six tetrahedra, which meet in the same diagonals;
 * surfaces "x0", "x1", "y0", "y1", "z0", "z1" are its sides.
 *
 * @param distortion inner points are moved by up to this share of a brick.
 */
fem::Mesh filled_mesh(const std::array<int, 3> &n, const std::array<double, 3> &size, const Filling &filling,
                      double distortion = 0.);

/// Of hexahedra.
fem::Mesh brick_mesh(const std::array<int, 3> &n, const std::array<double, 3> &size, double distortion = 0.);

/// Of prisms.
fem::Mesh prism_mesh(const std::array<int, 3> &n, const std::array<double, 3> &size, double distortion = 0.);

/// A half of hexahedra, and one of tetrahedra whose nodes are others, tied to it halfway along x; "x0" and "x1" are its
/// ends.
fem::Mesh tied_mesh(const std::array<double, 3> &size);

} // namespace gestell::test
