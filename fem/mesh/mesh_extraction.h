#pragma once

#include "fem/geometry/cad_model.h"
#include "fem/mesh/extracted_mesh.h"

#include <string>

namespace gestell::fem
{

/**
 * Extracts the tetrahedra from gmsh, in metres: cells positively oriented for any numbering of the file, the skin
 * (faces of one cell only) outward. Middle nodes of curved quadratic tetrahedra are kept. Meshes with hexahedra or
 * prisms are read by extract_mixed(). Unmerged coincident nodes and unused nodes become notes of the mesh.
 *
 * @param head  "<place>: <file>", prefix of messages
 * @throws std::invalid_argument if a solid has no cells, cells are not tetrahedra or have a duplicate corner, more than
 *         two cells share a face, adjacent cells are on the same side of their common face (one is inverted), or the
 *         number of bodies is not the expected one.
 */
ExtractedMesh extract_mesh(const CadModel &model, const std::string &head, const ExtractionOptions &options = {});

} // namespace gestell::fem
