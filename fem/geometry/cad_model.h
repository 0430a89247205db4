#pragma once

#include "fem/geometry/face.h"

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace gestell::fem
{

/// A closed body of the CAD model, or a group of cells in a mesh file; lengths in metres.
struct Solid
{
  int              tag = 0;
  std::string      name;
  double           volume = 0.;
  Vector3          min{}, max{};
  std::vector<int> faces;        ///< tags of its boundary
  std::string      material{};   ///< of the file, "" for none
  double           density = 0.; ///< of the file [kg/m^3], 0 for none
};

/// Named groups of nodes and of cell faces in a mesh file, in addition to volumes and surfaces; nodes by gmsh's tags.
struct MeshGroups
{
  std::map<std::string, std::vector<std::size_t>>              nodes;
  std::map<std::string, std::vector<std::vector<std::size_t>>> faces; ///< corners of each face
};

struct CadShape;

/// Contents of a CAD or mesh file; the geometry (and the mesh, if present) stays in gmsh.
struct CadModel
{
  double                   unit   = 1.;    ///< length of gmsh's unit [m]
  bool                     meshed = false; ///< read as a mesh (.msh): volumes and faces are not known yet
  std::vector<Solid>       solids;
  std::vector<Face>        faces; ///< between the solids and the outside, without faces between two solids
  Vector3                  min{}, max{};
  MeshGroups               groups;
  std::vector<std::string> notes;      ///< warnings
  std::vector<std::string> statements; ///< results without warning, such as joined solids

  std::shared_ptr<const CadShape> shape; ///< what gmsh was given; null: gmsh drew or changed it

  double diagonal() const;
  double volume() const;
};

/// A solid of gmsh's geometry, without name.  @param unit  length of gmsh's unit [m]
Solid measured_solid(int tag, double unit);

/// Whether the boxes around two solids touch or overlap.
bool boxes_touch(const Solid &a, const Solid &b, double tolerance);

} // namespace gestell::fem
