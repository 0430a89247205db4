#pragma once

#include "fem/geometry/cad_model.h"
#include "fem/mesh/extracted_mesh.h"
#include "fem/mesh/wall_thickness.h"

#include <array>
#include <map>
#include <string>
#include <vector>

namespace gestell::fem
{

/// Report of `gestell mesh`: faces for selectors, and mesh quality.
struct GeometryReport
{
  std::vector<Solid>                      solids;
  std::vector<Face>                       faces;    ///< outer faces
  std::map<std::string, std::vector<int>> surfaces; ///< named in the specification, with the tags of their faces
  Vector3                                 min{}, max{};
  double                                  size           = 0.; ///< of the elements [m]; 0 for a mesh file
  int                                     n_points       = 0;
  int                                     n_cells        = 0;
  int                                     n_coordinates  = 0;  ///< displacements with quadratic elements
  double                                  volume         = 0.; ///< of the mesh [m^3]
  double                                  worst_quality  = 0.; ///< 1 regular, 0 flat; see quality()
  double                                  mean_quality   = 0.;
  double                                  expected_cells = 0.; ///< estimate before meshing; 0 for a mesh file
  std::string                             smallest;            ///< edge and face of the geometry
  WallThickness                           walls;
  std::array<std::size_t, 3>              n_of_kind{}; ///< tetrahedra, hexahedra, prisms
  std::vector<std::string>                notes;       ///< warnings about the file
  std::vector<std::string>                statements;  ///< results without warning
  ExtractedMesh                           extracted;   ///< of a mesh: its skin shows the faces
};

} // namespace gestell::fem
