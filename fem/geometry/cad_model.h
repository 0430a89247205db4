#pragma once

#include "fem/geometry/cad_file.h"
#include "fem/geometry/face.h"
#include "fem/geometry/gmsh_session.h"
#include "fem/values/frame_specification.h"

#include <cstddef>
#include <map>
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
  std::vector<int> faces; ///< tags of its boundary
};

/// Names that a mesh file gives to nodes and to faces of cells beside its volumes and surfaces; nodes by gmsh's tags.
struct MeshGroups
{
  std::map<std::string, std::vector<std::size_t>>              nodes;
  std::map<std::string, std::vector<std::vector<std::size_t>>> faces; ///< corners of each face
};

/// What a CAD or mesh file holds; the geometry itself (and the mesh, if it came with one) stays in gmsh.
struct CadModel
{
  double                   unit   = 1.;    ///< length of gmsh's unit [m]
  bool                     meshed = false; ///< came as a mesh (.msh): volumes and faces are not known yet
  std::vector<Solid>       solids;
  std::vector<Face>        faces; ///< between the solids and the outside; faces between two solids are not among them
  Vector3                  min{}, max{};
  MeshGroups               groups;
  std::vector<std::string> notes;      ///< what a user should look at
  std::vector<std::string> statements; ///< what is as it should be, such as solids that were joined

  double diagonal() const;
  double volume() const;
};

/**
 * Reads a file of any kind into gmsh, for its solids; their faces are not looked at, nor whether they hang together.  A
 * .stl has triangles and no solids.
 *
 * A STEP file knows its unit.  source.unit > 0 overrides it: it is the true length [m] of what the file says to be a
 * millimetre (unit = 1 for a model drawn in metres that was written as millimetres).  For the other formats it is the
 * length of their unit, metre if not given.
 *
 * @throws std::invalid_argument if the file is missing, empty, of another kind, cut off or unreadable, holds no closed
 *         solid, or is smaller than 1 mm or larger than 200 m.
 */
CadModel open_cad(const CadSource &source, const GmshSession &session);

/// The file of a frame.
CadSource source_of(const FrameSpecification &specification);

/// What speaks for another unit of a frame that may be computed all the same, across less than 2 cm or more than 50 m:
/// a sentence with the value and the way out, or nothing.
std::string suspect_size(const CadModel &model, const CadSource &source);

/// A solid of gmsh's geometry, without name.  @param unit  length of gmsh's unit [m]
Solid measured_solid(int tag, double unit);

/// Whether the boxes around two solids touch or overlap.
bool boxes_touch(const Solid &a, const Solid &b, double tolerance);

/// Whether colours and layers of faces are looked for, which means to read a STEP file a second time.
enum class FaceAttributes
{
  read,
  left
};

/**
 * Reads the .step, .stp, .brep, .geo (OpenCASCADE kernel), .msh or .inp file of a frame into gmsh, as open_cad() does,
 * with its outer faces.  Solids of STEP and BREP files are joined where they touch, see join_solids().
 *
 * @throws std::invalid_argument as open_cad(), check_shells(), join_solids() and check_bodies().
 */
CadModel read_cad(const FrameSpecification &specification, const GmshSession &session,
                  FaceAttributes attributes = FaceAttributes::left);

} // namespace gestell::fem
