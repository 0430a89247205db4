#pragma once

#include "fem/assembly/quadratic_mesh.h"
#include "fem/values/mesh.h"

#include <array>
#include <vector>

namespace gestell::fem
{

/**
 * Nodes of triquadratic hexahedra: corners, middles of edges and of faces, and of the cells, for straight edges.
 *
 * @throws std::invalid_argument if a cell is turned inside out somewhere or an outer quadrilateral is no face.
 */
QuadraticMesh hexahedral_nodes(const Mesh &mesh);

/// Nodes of either kind of mesh: quadratic_mesh() or hexahedral_nodes().
QuadraticMesh number_nodes(const Mesh &mesh);

/// Number of those nodes.
int number_of_nodes(const Mesh &mesh);

/// Least of the determinants of dx/dxi at the corners of a cell, each over the product of the lengths of the three
/// edges there: 1 for a brick of any proportions, 0 or less where the cell folds.
double corner_quality(const Mesh &mesh, const std::array<int, 8> &cell);

/// The cells cut into tetrahedra for measuring: six of each hexahedron, or the tetrahedra themselves.
std::vector<std::array<int, 4>> tetrahedra_of(const Mesh &mesh);

} // namespace gestell::fem
