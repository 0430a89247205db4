#pragma once

#include "fem/mesh/mesh_quality.h"

#include <string>

namespace gestell::fem::test
{

/// Volume of the cells of a mesh of tetrahedra [m^3].
inline double volume_of_cells(const Mesh &mesh)
{
  double sum = 0.;
  for (const auto &cell : mesh.cells)
    sum += six_volumes(mesh, cell) / 6.;
  return sum;
}

/// Integral of the outward normal over a named surface [m^2].
inline Vector3 area_vector(const Mesh &mesh, const std::string &surface)
{
  Vector3 sum{};
  for (const int t : mesh.surfaces.at(surface))
  {
    const auto &[a, b, c] = mesh.skin[t];
    sum                   = sum + 0.5 * cross(mesh.points[b] - mesh.points[a], mesh.points[c] - mesh.points[a]);
  }
  return sum;
}

} // namespace gestell::fem::test
