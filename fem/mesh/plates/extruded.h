#pragma once

#include "fem/mesh/extracted_mesh.h"
#include "fem/mesh/mesh_size.h"
#include "fem/mesh/plates/plate_faces.h"
#include "fem/values/frame_specification.h"

#include <optional>
#include <set>
#include <string>
#include <vector>

namespace gestell::fem
{

/// A solid with the same section all along an axis, between plane ends at right angles to it: a tube, a pin, a wall
/// with oblique ends or with a round outline.
struct Extruded
{
  Axes                   axes;                   ///< the third along it
  double                 unit = 1.;              ///< length of gmsh's unit [m]
  double                 from = 0., to = 0.;     ///< levels of its ends [m]
  double                 area = 0.;              ///< of its section [m^2]
  std::vector<PlateFace> ends;                   ///< faces at its ends
  std::vector<Face>      sides;                  ///< faces parallel to its axis
  std::vector<int>       outline;                ///< edges around the section, at one end
  double                 inner = 0., outer = 0.; ///< radii of a tube, 0 for others [m]
  Point2                 centre{};               ///< of a tube
};

/// The solid as such, if it is one: along the shortest of its axes.
std::optional<Extruded> extruded(const Solid &solid, const std::vector<Face> &all, double unit);

/// Whether another solid is on an end, with parts of it around.
/// @param contacts  tags of faces that other solids share
bool carries_others(const Extruded &extruded, const std::set<int> &contacts);

/**
 * Hexahedra along the solid, from quadrilaterals in its section.  A tube has rings of 12 sides.  Polygons have the
 * areas of the curves, so that mass and stiffness are those of the solid.
 *
 * @param contacts  tags of faces that other solids share: cells have sides along footprints on the ends
 * @throws NotSwept if the section cannot be meshed
 */
ExtractedMesh extruded_mesh(const Extruded &extruded, const Solid &solid, const std::set<int> &contacts,
                            const MeshOptions &options, const std::string &head);

} // namespace gestell::fem
