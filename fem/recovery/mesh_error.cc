#include "fem/recovery/mesh_error.h"

#include "fem/assembly/elasticity.h"
#include "fem/assembly/mesh_ties.h"
#include "fem/recovery/patch_recovery.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace gestell::fem
{

namespace
{

/// eta_K^2 for every field: both stresses are polynomials that nodal values determine.
Eigen::RowVectorXd of_cell(const QuadraticMesh &mesh, const Material &material, int cell, CellValues &at_nodes,
                           CellValues &rule, const NodalFields &u, const Stresses &smooth)
{
  Stresses error(2 * u.rows(), mesh.n_nodes_of(cell));
  stresses_at(at_nodes.of(cell), mesh, material, cell, u, error);
  for (Eigen::Index a = 0; a < error.cols(); ++a)
    error.col(a) -= smooth.col(mesh.nodes(cell)[a]);
  const Stresses     weighted = error * mass_matrix(rule.of(cell), 1.);
  Eigen::RowVectorXd eta2     = Eigen::RowVectorXd::Zero(u.rows() / 3);
  for (Eigen::Index field = 0; field < eta2.size(); ++field)
    for (Eigen::Index a = 0; a < error.cols(); ++a)
      eta2[field] +=
          energy_product(error.col(a).segment<6>(6 * field), weighted.col(a).segment<6>(6 * field), material);
  return eta2;
}

/// Cells by their elasticity; stresses jump where it changes, so fits must not reach across.
std::vector<std::vector<int>> cells_alike(const CellMaterials &materials, int n_cells)
{
  std::map<std::pair<double, double>, std::vector<int>> lists;
  for (int cell = 0; cell < n_cells; ++cell)
    lists[{materials[cell].E, materials[cell].nu}].push_back(cell);
  std::vector<std::vector<int>> result;
  for (auto &[elasticity, cells] : lists)
    result.push_back(std::move(cells));
  return result;
}

} // namespace

MeshError::MeshError(QuadraticMesh mesh, CellMaterials materials, AffineConstraints affine)
    : mesh_(std::move(mesh)), materials_(std::move(materials)), affine_(std::move(affine))
{
}

Eigen::MatrixXd MeshError::of_cells(const Eigen::Ref<const Eigen::MatrixXd> &q) const
{
  const std::vector<std::vector<int>> alike = cells_alike(materials_, mesh_.n_cells());
  Eigen::MatrixXd                     result(mesh_.n_cells(), q.cols());
  CellValues                          at_nodes(mesh_, CellPoints::nodes), rule(mesh_, CellPoints::rule);
  constexpr int                       fields_once = 6; // fields whose stresses are in memory at the same time
  for (int first = 0; first < q.cols(); first += fields_once)
  {
    const int   fields = std::min<int>(fields_once, static_cast<int>(q.cols()) - first);
    NodalFields u(3 * fields, mesh_.n_nodes());
    for (int field = 0; field < fields; ++field)
      u.middleRows<3>(3 * field) = affine_.expand(q.col(first + field)).reshaped(3, mesh_.n_nodes());
    for (const auto &cells : alike)
    {
      const Material &material = materials_[cells.front()];
      const Stresses  smooth   = recovered_stresses(mesh_, material, cells, u);
      for (const int cell : cells)
        result.row(cell).segment(first, fields) = of_cell(mesh_, material, cell, at_nodes, rule, u, smooth);
    }
  }
  return result;
}

Eigen::VectorXd MeshError::of_ties(const Eigen::Ref<const Eigen::MatrixXd> &q) const
{
  if (mesh_.ties.empty())
    return {};
  Eigen::VectorXd       result = Eigen::VectorXd::Zero(q.cols());
  const Eigen::MatrixXd u      = [&]
  {
    Eigen::MatrixXd all(affine_.n_displacements(), q.cols());
    for (Eigen::Index field = 0; field < q.cols(); ++field)
      all.col(field) = affine_.expand(q.col(field));
    return all;
  }();
  for (const QuadraticTie &tie : mesh_.ties)
  {
    const std::vector<TiedPoint> points = tied_points(mesh_, tie);
    for (Eigen::Index field = 0; field < q.cols(); ++field)
      result[field] += 2. * tie_work(mesh_, points, materials_, u.col(field));
  }
  return result;
}

double relative_frequency_error(double share)
{
  return share < 1. ? 1. / std::sqrt(1. - share) - 1. : std::numeric_limits<double>::infinity();
}

} // namespace gestell::fem
