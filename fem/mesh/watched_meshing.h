#pragma once

#include "fem/geometry/cad_model.h"
#include "fem/geometry/gmsh_session.h"
#include "fem/mesh/mesh_size.h"
#include "fem/mesh/size_field.h"
#include "fem/values/frame_specification.h"

#include <functional>
#include <optional>
#include <string>

namespace gestell::fem
{

/// Place and file of a frame, which head its messages.
std::string head_of(const FrameSpecification &specification);

/// @param what  "the mesh has 30000 cells", which begins the message
/// @throws std::invalid_argument for more than mesh.max_cells
void require_cells(double n, const std::string &what, const MeshOptions &options);

/// Where the sizes of the surfaces' triangles come from.
struct SurfaceSizes
{
  MeshOptions              options;
  std::optional<SizeField> refined;                  ///< of a refinement
  bool                     script_has_sizes = false; ///< sizes drawn by a script
};

/// Meshes the surfaces; again with sizes that grow from short edges if those give far more triangles than intended.
/// @throws std::invalid_argument if gmsh fails, or if the triangles indicate too many cells
void mesh_surfaces(CadModel &model, const Selection &selection, const FrameSpecification &specification,
                   const GmshSession &session, const SurfaceSizes &sizes);

/// What meshes the volumes of gmsh's model on the mesh of their surfaces.
using VolumeMesher = std::function<void()>;

/**
 * Delaunay, since gmsh's HXT numbers points by their address in memory: every run would give another mesh. HXT takes
 * its place where it fails, and a note of the model says so.
 *
 * @param delaunay  the first attempt; empty: that of gmsh.
 * @throws std::invalid_argument where both fail
 */
void mesh_volumes(CadModel &model, const FrameSpecification &specification, const GmshSession &session,
                  const VolumeMesher &delaunay = {});

} // namespace gestell::fem
