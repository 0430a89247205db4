#pragma once

#include "fem/values/mesh.h"

#include <array>
#include <vector>

namespace gestell::fem
{

/// Nodes of the quadratic cells: points, edges, quadrilateral faces and hexahedra, each counted once.
int number_of_nodes(const Mesh &mesh);

/// Smallest corner determinant of dx/dxi of a cell, relative to the product of the three edge lengths there: 1 for a
/// brick of any proportions, sqrt(3)/2 for a prism with equal sides, 0 or less where the cell folds.
double corner_quality(const Mesh &mesh, int cell);

/// 1 for the best of its kind, 0 for a flat cell: quality() of tetrahedra, corner_quality() over that of a brick or of
/// a prism with equal sides.
double cell_quality(const Mesh &mesh, int cell);

/// The cells cut into tetrahedra for measuring: six of each hexahedron, three of each prism, or tetrahedra themselves.
std::vector<std::array<int, 4>> tetrahedra_of(const Mesh &mesh);

} // namespace gestell::fem
