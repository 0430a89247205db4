#pragma once

#include "fem/values/vector3.h"

#include <array>
#include <vector>

namespace gestell::fem
{

using Point2 = std::array<double, 2>;
using Side   = std::array<Point2, 2>;
using Axes   = std::array<Vector3, 3>; ///< right-handed, of unit length

/// A closed line of edges around a face or a hole in it.
struct FaceLoop
{
  std::vector<int>  edges; ///< tags of gmsh
  std::vector<Side> sides; ///< curves as polygons [m]
};

/// A polygon of few sides, in order around it, and the edge of each side.
struct Outline
{
  std::vector<Side> sides;
  std::vector<int>  edge;
  Point2            min{}, max{};
};

/// Where edges are drawn: points x have the coordinates x_(d + 1) and x_(d + 2) in the axes, counted modulo 3.
struct DrawingPlane
{
  Axes   axes;
  int    direction = 0;  ///< d
  double unit      = 1.; ///< length of gmsh's unit [m]
};

/// Groups of edges that are connected at their ends.
std::vector<std::vector<int>> loops_of(const std::vector<int> &edges);

/// Sides as they come, 64 to a curve.
FaceLoop face_loop(const std::vector<int> &edges, const DrawingPlane &plane);

/// Sides in order, an even number for each edge, 16 for a circle.
/// @param longest  side of an edge [m]
Outline outline_of(const std::vector<int> &edges, const DrawingPlane &plane, double longest = 1e300);

/// Factor from the radius of a circle to that of the corners of a polygon of equal area, whose sides turn by an angle.
double corner_factor(double turn);

/// The outline with corners on curves moved so that the polygon has the area of the curves.
Outline of_equal_area(const Outline &outline);

/// First corners of the sides.
std::vector<Point2> corners_of(const Outline &outline);

/// Whether a ray crosses an odd number of sides.
bool is_inside(const std::vector<Side> &sides, const Point2 &x);

} // namespace gestell::fem
