#pragma once

#include "fem/geometry/cad_model.h"
#include "fem/mesh/extracted_mesh.h"
#include "fem/mesh/size_field.h"
#include "fem/mesh/wall_thickness.h"
#include "fem/values/frame_specification.h"
#include "fem/values/mesh.h"

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace gestell::fem
{

/// Called with the name of the phase that begins and the share done, 0..1 (negative: unknown).
using MeshProgress = std::function<void(const std::string &phase, double share)>;

/**
 * Mesh of the frame with its named surfaces.
 *
 * STEP, BREP and .geo are meshed with linear tetrahedra of specification.mesh.size, smaller on
 * surfaces that ask for it.  A .msh or .inp file is taken as it is: mesh.size has no meaning then, and selectors act on
 * its surfaces (of the mesh, with their groups) by their triangles, see divide_skin().  Equal input gives an equal
 * mesh; no file is written; gmsh is left finalised.
 *
 * @param refined  sizes at points, in place of mesh.size where they are smaller; see refine().
 * @throws std::invalid_argument for bad input, see read_cad, select_faces, set_mesh_sizes, extract_mesh.
 */
Mesh make_mesh(const FrameSpecification &specification, const MeshProgress &progress = {},
               const std::vector<SizePoint> &refined = {});

/// What `gestell mesh` tells: all that is needed to write selectors, and how good the mesh is.
struct GeometryReport
{
  std::vector<Solid>                      solids;
  std::vector<Face>                       faces;    ///< outer faces
  std::map<std::string, std::vector<int>> surfaces; ///< named in the specification: tags of their faces
  Vector3                                 min{}, max{};
  double                                  size           = 0.; ///< of the elements [m]; 0 for a mesh file
  int                                     n_points       = 0;
  int                                     n_cells        = 0;
  int                                     n_coordinates  = 0;  ///< displacements with quadratic elements
  double                                  volume         = 0.; ///< of the mesh [m^3]
  double                                  worst_quality  = 0.; ///< 1 regular, 0 flat; see quality()
  double                                  mean_quality   = 0.;
  double                                  expected_cells = 0.; ///< judged before meshing; 0 for a mesh file
  std::string                             smallest;            ///< edge and face of the geometry
  WallThickness                           walls;
  std::array<std::size_t, 3>              n_of_kind{}; ///< tetrahedra, hexahedra, prisms
  std::vector<std::string>                notes;       ///< what a user should look at in the file
  std::vector<std::string>                statements;  ///< what is as it should be
  ExtractedMesh                           extracted;   ///< of report_geometry(): its skin shows the faces
};

/// Meshes and reports; if specification.mesh.size is 0, with a size that gives about 25000 cells.
GeometryReport report_geometry(const FrameSpecification &specification, const MeshProgress &progress = {});

/**
 * Reads the file and finds the surfaces as for a mesh, and judges sizes and memory, but meshes nothing (a script that
 * meshes by itself does): counts and qualities of cells stay 0.
 *
 * @throws std::invalid_argument as make_mesh() until its mesh, and check_solids_of_materials().
 */
GeometryReport inspect_geometry(const FrameSpecification &specification);

} // namespace gestell::fem
