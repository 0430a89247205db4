#pragma once

#include "fem/mesh/extracted_mesh.h"
#include "fem/mesh/mesh_size.h"
#include "fem/mesh/plates/plate_faces.h"
#include "fem/mesh/plates/wall_statement.h"
#include "fem/values/frame_specification.h"

#include <set>
#include <vector>

namespace gestell::fem
{

/// Solids whose walls are parallel, and what they are swept with.
struct PlateGroup
{
  std::vector<Solid> solids;
  std::set<int>      contacts; ///< faces that solids outside the group share
};

struct SweptMesh
{
  ExtractedMesh extracted; ///< with the skin at other solids
  WallCount     walls;
};

/**
 * Mesh of solids in gmsh with hexahedra that follow their walls: bricks between the planes of their faces, where
 * such a plane divides them, subdivided by cell_limits() up to mesh.size.  Solids are numbered as in the group.
 *
 * @param all  faces of these solids and others
 * @param selection  tags of the faces of the named surfaces; a size of a surface limits its cells
 * @throws NotSwept with the obstacle, std::invalid_argument as extract_mesh() does.
 */
SweptMesh swept_mesh(const CadModel &model, const PlateGroup &group, const std::vector<Face> &all,
                     const Selection &selection, const FrameSpecification &specification, const MeshOptions &options);

} // namespace gestell::fem
