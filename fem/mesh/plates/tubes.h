#pragma once

#include "fem/mesh/extracted_mesh.h"
#include "fem/mesh/mesh_size.h"
#include "fem/mesh/plates/plate_faces.h"
#include "fem/values/frame_specification.h"

#include <array>
#include <optional>
#include <vector>

namespace gestell::fem
{

/// A straight tube or ring with plane ends at right angles to its axis.
struct Tube
{
  Axes                   axes;                   ///< the third along it
  Vector3                origin{};               ///< on its axis
  double                 from = 0., to = 0.;     ///< along the axis, from the origin [m]
  double                 inner = 0., outer = 0.; ///< radii [m]
  std::vector<PlateFace> ends;                   ///< faces at right angles to its axis
  std::vector<Face>      sides;
  double                 unit = 1.; ///< length of gmsh's unit [m]
};

/// The solid as a tube, if it is one.
std::optional<Tube> tube_of(const Solid &solid, const std::vector<Face> &all, double unit);

/// Hexahedra along the tube and around it: polygons of 12 sides with the areas of both circles, so that mass and
/// stiffness against tension and bending are those of the tube.
ExtractedMesh tube_mesh(const Tube &tube, const Solid &solid, const MeshOptions &options, const std::string &head);

} // namespace gestell::fem
