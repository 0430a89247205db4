#pragma once

#include "fem/cad_file.h"
#include "fem/face.h"
#include "fem/frame_specification.h"
#include "fem/gmsh_session.h"

#include <string>
#include <vector>

namespace gestell::fem
{

/// A closed body of the CAD model, or a group of tetrahedra in a mesh file; lengths in metres.
struct Solid
{
  int              tag = 0;
  std::string      name;
  double           volume = 0.;
  Vector3          min{}, max{};
  std::vector<int> faces; ///< tags of its boundary
};

/// What a CAD or mesh file holds; the geometry itself (and the mesh, if it came with one) stays in gmsh.
struct CadModel
{
  double             unit   = 1.;    ///< length of gmsh's unit [m]
  bool               meshed = false; ///< came as a mesh (.msh): volumes and faces are not known yet
  std::vector<Solid> solids;
  std::vector<Face>  faces; ///< between the solids and the outside; faces between two solids are not among them
  Vector3            min{}, max{};

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

/// Whether the boxes around two solids touch or overlap.
bool boxes_touch(const Solid &a, const Solid &b, double tolerance);

/**
 * Reads the .step, .stp, .brep, .geo (OpenCASCADE kernel) or .msh file of a frame into gmsh, as open_cad() does, with
 * its outer faces.
 *
 * @throws std::invalid_argument as open_cad(), or if its solids do not hang together by common faces.
 */
CadModel read_cad(const FrameSpecification &specification, const GmshSession &session);

} // namespace gestell::fem
