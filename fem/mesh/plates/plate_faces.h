#pragma once

#include "fem/geometry/cad_model.h"
#include "fem/mesh/plates/outlines.h"

#include <stdexcept>
#include <string>
#include <vector>

namespace gestell::fem
{

/// Reason and location why a solid cannot be swept; a sentence of a note.
class NotSwept : public std::runtime_error
{
public:
  explicit NotSwept(const std::string &reason, int of_solid = -1) : std::runtime_error(reason), solid(of_solid) {}
  int solid; ///< among those to be swept; -1: not known
};

/// A face normal to an axis of its solids.  A point (x0 x1 x2) in these axes has the coordinates x_(d + 1) and x_(d +
/// 2) in the face, counted modulo 3.
struct PlateFace
{
  int                   tag       = 0;
  int                   direction = 0;  ///< d of the axis along its normal
  double                level     = 0.; ///< x_d [m]
  std::vector<FaceLoop> loops;
  Point2                min{}, max{};
};

/// A straight hole through material, with walls parallel to an axis; or the footprint of another solid on it.
struct PlateHole
{
  int               direction = 0; ///< of its axis
  double            from = 0., to = 0.;
  std::vector<Side> sides; ///< of its section
  std::vector<int>  wall;  ///< tag of the face on each side
  Point2            min{}, max{};
  int               solid  = 0;     ///< that has it
  bool              filled = false; ///< a footprint: the material continues inside
};

/// The loop around the face, which others are in; none for a face whose loop was that of a hole.
const FaceLoop *outer_loop(const PlateFace &face);

/// Solids with all faces normal to three axes, except the walls of holes.
struct PlateSolids
{
  Axes                          axes;
  std::vector<PlateFace>        faces;
  std::vector<std::vector<int>> of_solid; ///< into faces
  std::vector<PlateHole>        holes;    ///< their loops are not among those of faces

  /// Whether a point of the plane of a face is inside it, by the number of sides that a ray crosses.
  static bool contains(const PlateFace &face, const Point2 &x);
};

/// All faces of the solids, including those between two of them.
std::vector<Face> all_faces(const CadModel &model);

/// A face at right angles to an axis.
PlateFace plate_face(const Face &face, const DrawingPlane &plane);

/**
 * The faces of solids in gmsh in their own axes, the normals of most of their area.
 *
 * @param all  faces of these solids and others
 * @throws NotSwept with the first face that is neither normal to an axis nor the wall of a straight through hole.
 */
PlateSolids plate_solids(const std::vector<Solid> &solids, const std::vector<Face> &all, double unit);

} // namespace gestell::fem
