#pragma once

#include "fem/geometry/cad_model.h"

#include <array>
#include <stdexcept>
#include <string>
#include <vector>

namespace gestell::fem
{

/// Reason and location why a solid is not swept; a sentence of a note.
class NotSwept : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

using Point2 = std::array<double, 2>;
using Side   = std::array<Point2, 2>;

/// A closed line of edges around a face or a hole in it.
struct FaceLoop
{
  std::vector<int>  edges; ///< tags of gmsh
  std::vector<Side> sides; ///< curves as polygons [m]
};

/// A face at right angles to an axis of its solids.  Of a point (x0 x1 x2) in these axes the coordinates in the face
/// are x_(d + 1) and x_(d + 2), counted modulo 3.
struct PlateFace
{
  int                   tag       = 0;
  int                   direction = 0;  ///< d of the axis along its normal
  double                level     = 0.; ///< x_d [m]
  std::vector<FaceLoop> loops;
  Point2                min{}, max{};
};

/// A hole straight through material: its walls are parallel to an axis.
struct PlateHole
{
  int               direction = 0; ///< of its axis
  double            from = 0., to = 0.;
  std::vector<Side> sides; ///< of its section
  std::vector<int>  wall;  ///< tag of the face on each side
  Point2            min{}, max{};
};

/// Solids all of whose faces stand at right angles to three axes, but for the walls of holes.
struct PlateSolids
{
  std::array<Vector3, 3>        axes; ///< right-handed, of unit length
  std::vector<PlateFace>        faces;
  std::vector<std::vector<int>> of_solid; ///< into faces
  std::vector<PlateHole>        holes;    ///< none of the loops of faces is one of theirs

  /// Whether a point of the plane of a face lies within it, by the sides that a ray crosses.
  static bool contains(const PlateFace &face, const Point2 &x);
};

/**
 * The faces of the solids in gmsh in axes of their own, those along which most of their area looks.
 *
 * @throws NotSwept with the first face that is neither at right angles to an axis nor the wall of a hole straight
 *         through material.
 */
PlateSolids plate_solids(const CadModel &model);

} // namespace gestell::fem
