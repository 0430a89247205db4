#include "fem/mesh/joined_cells.h"

#include "fem/values/cell_shape.h"
#include "fem/values/vector3.h"

#include <cmath>

namespace gestell::fem
{

namespace
{

Point3 mean_of_corners(const Mesh &mesh, int cell)
{
  const int n = cell_shape(mesh.kind(cell)).n_corners;
  Point3    sum{};
  for (int k = 0; k < n; ++k)
    sum = sum + mesh.points[mesh.corners(cell)[k]];
  return (1. / n) * sum;
}

} // namespace

bool lie_apart(const Mesh &mesh, int first, int face, int second)
{
  const std::vector<int> &corners = cell_shape(mesh.kind(first)).faces[face];
  const auto              at      = [&](int k) { return mesh.points[mesh.corners(first)[corners[k]]]; };
  const bool              quad    = corners.size() == 4;
  const Vector3           normal  = quad ? cross(at(2) - at(0), at(3) - at(1)) : cross(at(1) - at(0), at(2) - at(0));
  const Point3            middle  = quad ? 0.25 * (at(0) + at(1) + at(2) + at(3)) : (1. / 3.) * (at(0) + at(1) + at(2));
  const double            in_first  = dot(normal, mean_of_corners(mesh, first) - middle);
  const double            in_second = dot(normal, mean_of_corners(mesh, second) - middle);
  const double            flat      = 1e-9 * std::pow(norm(normal), 1.5); // area times a height of 1e-9 sides
  return in_first * in_second <= 0. || std::abs(in_first) < flat || std::abs(in_second) < flat;
}

} // namespace gestell::fem
