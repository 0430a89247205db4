#pragma once

#include "fem/mesh/mesh_size.h"
#include "fem/mesh/solids/joined_meshes.h"
#include "fem/values/frame_specification.h"

#include <map>
#include <string>
#include <vector>

namespace gestell::fem
{

/// Meshes of the solids that can be swept.  A mesh that comes earlier leads where two meet.
struct SweptSolids
{
  std::vector<PartialMesh>   meshes;
  std::map<int, std::string> others;    ///< remaining solids, with the reason
  std::string                statement; ///< "plates are swept: ..."
};

/**
 * Sweeps walls, those with parallel faces in one mesh, and solids along an axis; see swept_mesh() and extruded_mesh().
 * What cannot be swept or joined with the others remains.
 *
 * @throws std::invalid_argument for too many cells.
 */
SweptSolids sweep_solids(const CadModel &model, const Selection &selection, const FrameSpecification &specification,
                         const MeshOptions &options);

/// States what is swept, and notes why other solids become tetrahedra.
void state_solids(CadModel &model, const SweptSolids &swept, const MeshOptions &options);

/// Removes the swept solids from gmsh.  @return the others, with the faces that bound them
CadModel alone_in_gmsh(const CadModel &model, const SweptSolids &swept);

/// The selected faces that are among these.
Selection among(const std::vector<Face> &faces, const Selection &selection);

} // namespace gestell::fem
