#pragma once

#include "fem/geometry/cad_model.h"
#include "fem/mesh/extracted_mesh.h"

#include <functional>
#include <string>
#include <vector>

namespace gestell::fem
{

/**
 * Extracts hexahedra, prisms and adjacent tetrahedra from gmsh, like extract_mesh() for tetrahedra: outer
 * quadrilaterals are stored as such and as two triangles, with the surface of each triangle in `skin_surface`.  Only
 * the corners of cells of higher order are used.
 *
 * @throws std::invalid_argument if a solid has no cells, more than two cells share a face, a quadrilateral of one cell
 *         meets triangles of others, or if the number of bodies is not the expected one.
 */
ExtractedMesh extract_mixed(const CadModel &model, const std::string &head, const ExtractionOptions &options);

/// Tag of the surface of an outer face with these corners (points of the mesh), 0 for none.
using SurfaceOf = std::function<int(const std::vector<int> &corners)>;

/**
 * Adds the faces that belong to one cell only, oriented outward, with their surfaces.
 *
 * @param bodies  expected number connected by common faces; 0: any
 * @throws std::invalid_argument if triangles meet quadrilaterals, or for another number of bodies.
 */
void add_skin(ExtractedMesh &mesh, const std::string &head, int bodies, const SurfaceOf &surface_of);

} // namespace gestell::fem
