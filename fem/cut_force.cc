#include "fem/cut_force.h"

#include "fem/elasticity.h"
#include "fem/reference_cell.h"

#include <algorithm>
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

Eigen::Vector3d unit_normal(const CutSpecification &cut)
{
  const Eigen::Vector3d normal(cut.normal[0], cut.normal[1], cut.normal[2]);
  if (!(normal.norm() > 0.) || !normal.allFinite())
    throw std::invalid_argument(head(cut) + ": the normal has no direction; give three numbers such as [0, 0, 1].");
  return normal.normalized();
}

/// Distance of the centroid of every cell from the plane, positive where the normal points.
std::vector<double> heights(const CutSpecification &cut, const Eigen::Vector3d &normal, const QuadraticMesh &mesh)
{
  const Eigen::Vector3d through(cut.through[0], cut.through[1], cut.through[2]);
  std::vector<double>   result;
  result.reserve(mesh.n_cells());
  for (int cell = 0; cell < mesh.n_cells(); ++cell)
  {
    Eigen::Vector3d         centroid = Eigen::Vector3d::Zero();
    const std::vector<int> &corners  = reference_cell(mesh).corners;
    for (const int k : corners)
      centroid += Eigen::Map<const Eigen::Vector3d>(mesh.points[mesh.nodes(cell)[k]].data());
    result.push_back(normal.dot(centroid / static_cast<double>(corners.size()) - through));
  }
  return result;
}

/// Nodes of cells below; their share with the cells above is the cut.
std::vector<char> nodes_below(const QuadraticMesh &mesh, const std::vector<double> &height)
{
  std::vector<char> below(mesh.n_nodes(), 0);
  for (int cell = 0; cell < mesh.n_cells(); ++cell)
    if (height[cell] <= 0.)
      for (int a = 0; a < mesh.nodes_per_cell(); ++a)
        below[mesh.nodes(cell)[a]] = 1;
  return below;
}

[[noreturn]] void refuse(const CutSpecification &cut, const std::vector<double> &height)
{
  const auto [low, high] = std::minmax_element(height.begin(), height.end());
  std::ostringstream message;
  message << head(cut) << ": the plane does not cut the frame, which reaches from " << *low << " m to " << *high
          << " m along the normal as seen from the point (" << cut.through[0] << ", " << cut.through[1] << ", "
          << cut.through[2] << ") m; move the point into the frame.";
  throw std::invalid_argument(message.str());
}

} // namespace

FrameOutput cut_force(const CutSpecification &cut, const QuadraticMesh &mesh, const CellMaterials &materials,
                      const Kinematics &kinematics, double rayleigh_stiffness)
{
  const Eigen::Vector3d     normal = unit_normal(cut);
  const std::vector<double> height = heights(cut, normal, mesh);
  const std::vector<char>   below  = nodes_below(mesh, height);

  bool            divides = false;
  Eigen::VectorXd row     = Eigen::VectorXd::Zero(3 * mesh.n_nodes());
  const int       n       = mesh.nodes_per_cell();
  for (int cell = 0; cell < mesh.n_cells(); ++cell)
  {
    const int *nodes = mesh.nodes(cell);
    if (height[cell] <= 0. || std::none_of(nodes, nodes + n, [&](int node) { return below[node]; }))
      continue;
    divides               = true;
    const CellStiffness C = cell_stiffness(mesh, cell, materials[cell]);
    for (int a = 0; a < n; ++a)
      if (below[nodes[a]])
        for (int b = 0; b < n; ++b)
          row.segment<3>(3 * nodes[b]) -= C.block<3, 3>(3 * a, 3 * b).transpose() * normal;
  }
  if (!divides)
    refuse(cut, height);
  const Eigen::VectorXd on_q = kinematics.gather(row);
  return {"cut." + cut.name, "N", on_q, rayleigh_stiffness * on_q};
}

} // namespace gestell::fem
