#include "fem/recovery/prestress.h"

#include "fem/assembly/attached_masses.h"
#include "fem/assembly/elasticity.h"
#include "fem/assembly/mass_integrals.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace gestell::fem
{

namespace
{

Eigen::Map<const Eigen::Vector3d> mapped(const std::array<double, 3> &x)
{
  return Eigen::Map<const Eigen::Vector3d>(x.data());
}

/// Forces of the nodes on the cells around marked nodes [3 x n_nodes].
Eigen::Matrix3Xd cell_forces(const QuadraticMesh &mesh, const CellMaterials &materials, const std::vector<char> &marked)
{
  Eigen::Matrix3Xd f = Eigen::Matrix3Xd::Zero(3, mesh.n_nodes());
  CellValues       values(mesh, CellPoints::rule);
  for (int cell = 0; cell < mesh.n_cells(); ++cell)
  {
    const std::vector<int> nodes(mesh.nodes(cell), mesh.nodes(cell) + mesh.n_nodes_of(cell));
    if (std::none_of(nodes.begin(), nodes.end(), [&](int node) { return marked[node]; }))
      continue;
    const Eigen::Matrix3Xd u  = materials.u0(Eigen::all, nodes);
    const Eigen::VectorXd  Cu = stiffness_matrix(values.of(cell), materials[cell]) * u.reshaped();
    f(Eigen::all, nodes) += Cu.reshaped(3, Eigen::Index(nodes.size()));
  }
  return f;
}

/// Entries of K of a force c that holds a point at r from the node.
void add_turn(const Interface &node, const Eigen::Vector3d &c, const Eigen::Vector3d &r,
              std::vector<Eigen::Triplet<double>> &entries)
{
  const Eigen::Matrix3d cr = c * r.transpose(),
                        K  = 0.5 * (cr + cr.transpose()) - c.dot(r) * Eigen::Matrix3d::Identity();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (const int row = node.coordinate[rx + i], column = node.coordinate[rx + j]; row >= 0 && column >= 0)
        entries.emplace_back(row, column, K(i, j));
}

/// Whether the node has rotations, those of its face or their mean.
bool turns(const CoupledPatch &patch)
{
  return patch.specification.coupling != InterfaceCoupling::node;
}

} // namespace

Eigen::VectorXd PrestressLoads::on_masses(int n) const
{
  Eigen::VectorXd f = Eigen::VectorXd::Zero(n);
  for (const auto &[node, force, arm] : weights)
  {
    Eigen::Matrix<double, 6, 1> on_node;
    on_node << force, arm.cross(force);
    for (int i = 0; i < 6; ++i)
      if (node->coordinate[i] >= 0)
        f[node->coordinate[i]] += on_node[i];
  }
  return f;
}

PrestressLoads prestress_loads(const Prestress &prestress, const std::vector<AttachedMass> &masses, const Mesh &mesh,
                               const QuadraticMesh &quadratic, const CellMaterials &materials,
                               const std::vector<Interface> &nodes)
{
  const Eigen::Vector3d g = mapped(prestress.acceleration);
  Eigen::Matrix3Xd      f = g * nodal_masses(quadratic, materials, Eigen::Vector3d::Zero()).mass.transpose();
  for (const SurfaceLoad &load : prestress.loads)
  {
    const SurfacePatch patch = surface_patch(mesh, quadratic, load.surfaces, "load", load.place);
    f(Eigen::all, patch.nodes) +=
        mapped(load.force) * patch.weight.transpose() / patch.area - load.pressure * patch.normal;
  }
  PrestressLoads result{prestress.factor * f.reshaped(), {}};
  for (const AttachedMass &mass : masses)
  {
    const Interface &node = node_of(mass, nodes);
    result.weights.push_back(
        {&node, prestress.factor * mass.mass * g, properties_of(mass, node).centre - mapped(node.position)});
  }
  return result;
}

Eigen::SparseMatrix<double> stiffness_of_turns(const QuadraticMesh &mesh, const CellMaterials &materials, int n,
                                               const std::vector<CoupledPatch> &coupled,
                                               const std::vector<Interface> &nodes, const PrestressLoads &loads)
{
  std::vector<char> marked(mesh.n_nodes(), 0);
  for (const CoupledPatch &patch : coupled)
    if (turns(patch))
      for (const int node : patch.patch.nodes)
        marked[node] = 1;
  const Eigen::Matrix3Xd c =
      cell_forces(mesh, materials, marked) - loads.on_nodes.reshaped(3, Eigen::Index(mesh.n_nodes()));
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t k = 0; k < coupled.size(); ++k)
    if (turns(coupled[k]))
      for (const int node : coupled[k].patch.nodes)
        add_turn(nodes[k], c.col(node), mapped(mesh.points[node]) - coupled[k].position, entries);
  for (const auto &[node, force, arm] : loads.weights)
    add_turn(*node, -force, arm, entries);
  Eigen::SparseMatrix<double> K(n, n);
  K.setFromTriplets(entries.begin(), entries.end());
  return K;
}

} // namespace gestell::fem
