#pragma once

#include "fem/geometry/cad_model.h"
#include "fem/geometry/gmsh_session.h"
#include "fem/mesh/gmsh_child.h"
#include "fem/mesh/mesh_size.h"
#include "fem/mesh/size_field.h"
#include "fem/values/frame_specification.h"

#include <functional>
#include <optional>
#include <string>

namespace gestell::fem
{

/// Location and file of a frame, the prefix of its messages.
std::string head_of(const FrameSpecification &specification);

/// @param what  "the mesh has 30000 cells", beginning of the message
/// @throws std::invalid_argument for more than mesh.max_cells
void require_cells(double n, const std::string &what, const MeshOptions &options);

/// Origin of the sizes of the surface triangles.
struct SurfaceSizes
{
  MeshOptions              options;
  std::optional<SizeField> refined;                  ///< of a refinement
  bool                     script_has_sizes = false; ///< sizes drawn by a script
  WallSizes                walls            = WallSizes::where_needed;
};

/// Meshes the surfaces; again with sizes of faces whose triangles cut through walls, see faces_that_cut_walls(), and
/// with sizes that grow from short edges if those give far more triangles than intended.
/// @throws NotMeshed if gmsh fails, std::invalid_argument if the triangles indicate too many cells
void mesh_surfaces(CadModel &model, const Selection &selection, const FrameSpecification &specification,
                   const GmshSession &session, const SurfaceSizes &sizes);

/// Meshes the volumes of gmsh's model on the mesh of their surfaces.
using VolumeMesher = std::function<void()>;

/**
 * Meshes volumes with Delaunay, because gmsh's HXT numbers points by their memory address, so that every run would give
 * a different mesh.  If Delaunay fails, the surfaces are meshed by gmsh's Delaunay method as well, in place of its
 * frontal one; HXT is the last attempt. An attempt that leaves a solid without cells has failed.  Both put a note into
 * the model.
 *
 * @param delaunay  the first and second attempt; empty: that of gmsh.
 * @throws NotMeshed if all fail, with the solids that fail by themselves
 */
void mesh_volumes(CadModel &model, const FrameSpecification &specification, const GmshSession &session,
                  const VolumeMesher &delaunay = {});

} // namespace gestell::fem
