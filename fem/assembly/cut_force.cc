#include "fem/assembly/cut_force.h"

#include "fem/assembly/elasticity.h"
#include "fem/assembly/reference_cell.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <sstream>
#include <stdexcept>

namespace gestell::fem
{

namespace
{

std::string head(const CutSpecification &cut)
{
  const std::string owner = "cut \"" + cut.name + "\"";
  return cut.place.empty() ? owner : cut.place + ": " + owner;
}

/// A plane through the frame, and how far above it points lie.
struct Plane
{
  Eigen::Vector3d through, normal;

  double height(const Eigen::Vector3d &x) const { return normal.dot(x - through); }
};

Plane plane_of(const CutSpecification &cut)
{
  const Eigen::Vector3d normal(cut.normal[0], cut.normal[1], cut.normal[2]);
  if (!(normal.norm() > 0.) || !normal.allFinite())
    throw std::invalid_argument(head(cut) + ": the normal is zero; give three numbers such as [0, 0, 1].");
  return {Eigen::Vector3d(cut.through[0], cut.through[1], cut.through[2]), normal.normalized()};
}

/// Distance of the centroid of every cell from the plane, positive where the normal points.
std::vector<double> heights(const Plane &plane, const QuadraticMesh &mesh)
{
  std::vector<double> result;
  result.reserve(mesh.n_cells());
  for (int cell = 0; cell < mesh.n_cells(); ++cell)
  {
    Eigen::Vector3d centroid  = Eigen::Vector3d::Zero();
    const int       n_corners = reference_cell(mesh.kind(cell)).n_corners;
    for (int k = 0; k < n_corners; ++k)
      centroid += Eigen::Map<const Eigen::Vector3d>(mesh.points[mesh.nodes(cell)[k]].data());
    result.push_back(plane.height(centroid / static_cast<double>(n_corners)));
  }
  return result;
}

/// Nodes of cells below; their share with the cells above is the cut.
std::vector<char> nodes_below(const QuadraticMesh &mesh, const std::vector<double> &height)
{
  std::vector<char> below(mesh.n_nodes(), 0);
  for (int cell = 0; cell < mesh.n_cells(); ++cell)
    if (height[cell] <= 0.)
      for (int a = 0; a < mesh.n_nodes_of(cell); ++a)
        below[mesh.nodes(cell)[a]] = 1;
  return below;
}

[[noreturn]] void refuse(const CutSpecification &cut, const std::vector<double> &height)
{
  const auto [low, high] = std::minmax_element(height.begin(), height.end());
  std::ostringstream message;
  message << head(cut) << ": the plane does not cut the frame, which extends from " << *low << " m to " << *high
          << " m along the normal, measured from the point (" << cut.through[0] << ", " << cut.through[1] << ", "
          << cut.through[2] << ") m; move the point into the frame.";
  throw std::invalid_argument(message.str());
}

/// Share of a tetrahedron above a plane, from the distances of its corners to the plane.
double share_above(std::array<double, 4> d)
{
  std::sort(d.begin(), d.end(), std::greater<double>());
  const auto positive = std::count_if(d.begin(), d.end(), [](double x) { return x > 0.; });
  const auto cut      = [&d](int i, int j) { return d[i] / (d[i] - d[j]); }; // of the edge from i to the plane
  switch (positive)
  {
  case 0:
    return 0.;
  case 1:
    return cut(0, 1) * cut(0, 2) * cut(0, 3);
  case 2: // a prism, by three tetrahedra
    return cut(1, 2) * cut(1, 3) + cut(0, 3) * cut(1, 2) * (1. - cut(1, 3)) + cut(0, 2) * cut(0, 3) * (1. - cut(1, 2));
  case 3:
    return 1. - cut(3, 0) * cut(3, 1) * cut(3, 2);
  default:
    return 1.;
  }
}

/// Share of the volume of a cell, taken as straight, above a plane.
double share_above(const Plane &plane, const QuadraticMesh &mesh, int cell)
{
  std::vector<Eigen::Vector3d> x;
  for (const int k : reference_cell(mesh.kind(cell)).node_of_corner)
    x.emplace_back(Eigen::Map<const Eigen::Vector3d>(mesh.points[mesh.nodes(cell)[k]].data()));
  double volume = 0., above = 0.;
  for (const auto &[a, b, c, d] : cell_shape(mesh.kind(cell)).pieces)
  {
    const double part = std::abs((x[b] - x[a]).cross(x[c] - x[a]).dot(x[d] - x[a]));
    volume += part;
    above += part * share_above({plane.height(x[a]), plane.height(x[b]), plane.height(x[c]), plane.height(x[d])});
  }
  return above / volume;
}

} // namespace

FrameOutput cut_force(const CutSpecification &cut, const QuadraticMesh &mesh, const CellMaterials &materials,
                      const AffineConstraints &affine, double rayleigh_stiffness)
{
  const Plane               plane  = plane_of(cut);
  const std::vector<double> height = heights(plane, mesh);
  const std::vector<char>   below  = nodes_below(mesh, height);

  bool            divides = false;
  double          mass    = 0.; // above the plane, minus that of nodes whose loads the row contains
  Eigen::VectorXd row     = Eigen::VectorXd::Zero(3 * mesh.n_nodes());
  CellValues      values(mesh, CellPoints::rule);
  for (int cell = 0; cell < mesh.n_cells(); ++cell)
  {
    const int   *nodes      = mesh.nodes(cell);
    const int    n          = mesh.n_nodes_of(cell);
    const double share      = share_above(plane, mesh, cell);
    const bool   stands_out = height[cell] > 0.; // of the cells below
    const bool   touches    = stands_out && std::any_of(nodes, nodes + n, [&](int node) { return below[node]; });
    if (!touches && share == (stands_out ? 1. : 0.))
      continue;
    const Eigen::VectorXd nodal = mass_matrix(values.of(cell), materials[cell].rho).rowwise().sum();
    mass += share * nodal.sum();
    if (stands_out)
      for (int a = 0; a < n; ++a)
        mass -= below[nodes[a]] ? 0. : nodal[a];
    if (!touches)
      continue;
    divides                 = true;
    const Eigen::MatrixXd C = tangent_stiffness(values.of(cell), mesh, materials, cell);
    for (int a = 0; a < n; ++a)
      if (below[nodes[a]])
        for (int b = 0; b < n; ++b)
          row.segment<3>(3 * nodes[b]) -= C.block<3, 3>(3 * a, 3 * b).transpose() * plane.normal;
  }
  if (!divides)
    refuse(cut, height);
  const Eigen::VectorXd on_q = affine.gather(row);
  return {"cut." + cut.name, "N", on_q, rayleigh_stiffness * on_q, mass * plane.normal};
}

} // namespace gestell::fem
