#pragma once

#include "fem/geometry/cad_model.h"
#include "fem/mesh/extracted_mesh.h"

#include <string>

namespace gestell::fem
{

/**
 * Takes the tetrahedra out of gmsh, in metres: cells positively oriented however the file numbers them, the skin (faces
 * of one cell only) outward.  Middles of quadratic tetrahedra that are not straight are kept.  Meshes with
 * hexahedra or prisms are taken by extract_mixed().  Coincident nodes that join nothing, and nodes no cell uses, become
 * notes of the mesh.
 *
 * @param head  "<place>: <file>", heads messages
 * @throws std::invalid_argument if a solid has no cells, cells are no tetrahedra or twice the same point, more than two
 *         cells share a face, neighbouring cells lie on the same side of their common face (one is turned inside out),
 *         or there is another number of bodies than wanted.
 */
ExtractedMesh extract_mesh(const CadModel &model, const std::string &head, const ExtractionOptions &options = {});

} // namespace gestell::fem
