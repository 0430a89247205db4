#pragma once

#include "fem/mesh/extracted_mesh.h"
#include "fem/mesh/mesh_size.h"
#include "fem/mesh/plates/plate_faces.h"
#include "fem/values/frame_specification.h"

#include <string>

namespace gestell::fem
{

/**
 * Mesh of the solids in gmsh with hexahedra that follow their walls: bricks between the planes of their faces, where
 * such a plane divides them, subdivided by cell_limits() up to mesh.size.
 *
 * @param selection  tags of the faces of the named surfaces; a size of a surface limits its cells
 * @throws NotSwept with the obstacle, std::invalid_argument as extract_mesh() does.
 */
ExtractedMesh swept_mesh(const CadModel &model, const Selection &selection, const FrameSpecification &specification,
                         const MeshOptions &options);

} // namespace gestell::fem
