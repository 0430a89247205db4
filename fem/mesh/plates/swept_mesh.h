#pragma once

#include "fem/mesh/extracted_mesh.h"
#include "fem/mesh/mesh_size.h"
#include "fem/mesh/plates/plate_faces.h"
#include "fem/values/frame_specification.h"

#include <string>

namespace gestell::fem
{

/**
 * Mesh of the solids in gmsh in hexahedra that follow the walls they are made of: bricks between the planes of their
 * faces, as far as a plane cuts them, divided as in cell_limits() up to mesh.size.
 *
 * @param selection  tags of the faces of the named surfaces; those with a size have no larger cells
 * @throws NotSwept what cannot be divided so, std::invalid_argument as extract_mesh().
 */
ExtractedMesh swept_mesh(const CadModel &model, const Selection &selection, const FrameSpecification &specification,
                         const MeshOptions &options);

} // namespace gestell::fem
