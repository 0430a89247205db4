#pragma once

#include "fem/cad_model.h"
#include "fem/mesh.h"

#include <string>
#include <vector>

namespace gestell::fem
{

/// gmsh's mesh as a value, and where its skin comes from.
struct ExtractedMesh
{
  Mesh             mesh;         ///< without named surfaces
  std::vector<int> skin_surface; ///< for each triangle of the skin the tag of gmsh's surface, 0 if it has none
};

/**
 * Takes the tetrahedra out of gmsh, in metres: cells positively oriented, the skin (faces of one cell only) outward.
 * Of quadratic tetrahedra only the corners are kept.
 *
 * @param head  "<place>: <file>", heads messages
 * @throws std::invalid_argument if a solid has no cells, cells are no tetrahedra or flat, more than two cells share a
 *         face, or the cells do not hang together by common faces.
 */
ExtractedMesh extract_mesh(const CadModel &model, const std::string &head);

/// Six times the volume of the cell [m^3], positive if it is positively oriented.
double six_volumes(const Mesh &mesh, const std::array<int, 4> &cell);

/// 12 (3 V)^(2/3) / (sum of the squared edges): 1 for a regular tetrahedron, 0 for a flat one.
double quality(const Mesh &mesh, const std::array<int, 4> &cell);

/// Number of different edges of all cells: with the points the nodes of a quadratic mesh.
int number_of_edges(const Mesh &mesh);

} // namespace gestell::fem
