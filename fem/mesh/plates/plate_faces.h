#pragma once

#include "fem/geometry/cad_model.h"

#include <array>
#include <stdexcept>
#include <string>
#include <vector>

namespace gestell::fem
{

/// Reason and location why a solid cannot be swept; a sentence of a note.
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

/// A straight hole through material, with walls parallel to an axis.
struct PlateHole
{
  int               direction = 0; ///< of its axis
  double            from = 0., to = 0.;
  std::vector<Side> sides; ///< of its section
  std::vector<int>  wall;  ///< tag of the face on each side
  Point2            min{}, max{};
};

/// Solids with all faces normal to three axes, except the walls of holes.
struct PlateSolids
{
  std::array<Vector3, 3>        axes; ///< right-handed, of unit length
  std::vector<PlateFace>        faces;
  std::vector<std::vector<int>> of_solid; ///< into faces
  std::vector<PlateHole>        holes;    ///< their loops are not among those of faces

  /// Whether a point of the plane of a face is inside it, by the number of sides that a ray crosses.
  static bool contains(const PlateFace &face, const Point2 &x);
};

/**
 * The faces of the solids in gmsh in their own axes, the normals of most of their area.
 *
 * @throws NotSwept with the first face that is neither normal to an axis nor the wall of a straight through hole.
 */
PlateSolids plate_solids(const CadModel &model);

} // namespace gestell::fem
