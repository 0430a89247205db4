#pragma once

#include "fem/geometry/cad_model.h"
#include "fem/mesh/extracted_mesh.h"

#include <string>

namespace gestell::fem
{

/**
 * Takes hexahedra, prisms and tetrahedra beside them out of gmsh as extract_mesh() does tetrahedra alone: outer
 * quadrilaterals come as such and as their halves, the surface of each half in `skin_surface`.  Of cells of higher
 * order only the corners are kept.
 *
 * @throws std::invalid_argument if a solid has no cells, more than two cells share a face, a quadrilateral of one cell
 *         meets triangles of others, or there is another number of bodies than wanted.
 */
ExtractedMesh extract_mixed(const CadModel &model, const std::string &head, const ExtractionOptions &options);

} // namespace gestell::fem
