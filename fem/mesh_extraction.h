#pragma once

#include "fem/cad_model.h"
#include "fem/mesh.h"

#include <cstddef>
#include <string>
#include <vector>

namespace gestell::fem
{

/// gmsh's mesh as a value, and where its skin comes from.
struct ExtractedMesh
{
  Mesh                     mesh;         ///< without named surfaces
  std::vector<int>         skin_surface; ///< for each triangle of the skin the tag of gmsh's surface, 0 if it has none
  std::vector<std::size_t> node;         ///< for each point gmsh's tag
};

enum class Bodies
{
  one, ///< all cells hang together by common faces
  any
};

/**
 * Takes the tetrahedra out of gmsh, in metres: cells positively oriented, the skin (faces of one cell only) outward.
 * Of quadratic tetrahedra only the corners are kept.  A mesh of hexahedra is taken by extract_hexahedra().
 *
 * @param head  "<place>: <file>", heads messages
 * @throws std::invalid_argument if a solid has no cells, cells are no tetrahedra, more than two cells share a face, or
 *         there are more bodies than one where one is wanted.
 */
ExtractedMesh extract_mesh(const CadModel &model, const std::string &head, Bodies bodies = Bodies::one);

} // namespace gestell::fem
