#include "fem/assembly/reference_cell.h"

#include "fem/assembly/finite_elements.h"

#include <Eigen/LU>

#include <algorithm>
#include <numeric>
#include <utility>

namespace gestell::fem
{

namespace
{

Eigen::Matrix3Xd columns(const std::vector<dealii::Point<3>> &points)
{
  Eigen::Matrix3Xd xi(3, points.size());
  for (std::size_t k = 0; k < points.size(); ++k)
    xi.col(Eigen::Index(k)) << points[k][0], points[k][1], points[k][2];
  return xi;
}

std::vector<std::vector<int>> faces_of(const dealii::ReferenceCell &cell)
{
  std::vector<std::vector<int>> result;
  for (const unsigned int face : cell.face_indices())
  {
    result.emplace_back();
    for (unsigned int k = 0; k < cell.face_reference_cell(face).n_vertices(); ++k)
      result.back().push_back(static_cast<int>(cell.face_to_cell_vertices(face, k, 1)));
  }
  return result;
}

/// Sets of corners that have a node in their middle: single corners, edges, quadrilaterals, the cell.
std::vector<std::vector<int>> sets_of_corners(const std::vector<std::vector<int>> &faces, int n_corners)
{
  std::vector<std::vector<int>> sets(1, std::vector<int>(n_corners));
  std::iota(sets[0].begin(), sets[0].end(), 0);
  for (int corner = 0; corner < n_corners; ++corner)
    sets.push_back({corner});
  for (const auto &face : faces)
    if (face.size() == 3)
      for (int k = 0; k < 3; ++k)
        sets.push_back({face[k], face[(k + 1) % 3]});
    else
    {
      sets.push_back(face);
      for (const auto &[a, b] : {std::pair(0, 1), std::pair(2, 3), std::pair(0, 2), std::pair(1, 3)})
        sets.push_back({face[a], face[b]});
    }
  return sets;
}

std::vector<std::vector<int>> corners_between(const ReferenceCell &cell)
{
  const auto                    sets = sets_of_corners(cell.faces, cell.n_corners);
  std::vector<std::vector<int>> result;
  for (Eigen::Index a = 0; a < cell.n_nodes; ++a)
    result.push_back(*std::find_if(sets.begin(), sets.end(),
                                   [&](const std::vector<int> &set)
                                   {
                                     Eigen::Vector3d middle = Eigen::Vector3d::Zero();
                                     for (const int corner : set)
                                       middle += cell.nodes.col(corner) / static_cast<double>(set.size());
                                     return (middle - cell.nodes.col(a)).norm() < 1e-9;
                                   }));
  return result;
}

/// Products of 1, xi, eta, zeta, as many as there are samples: linear, and bilinear or trilinear across quadrilaterals.
Eigen::VectorXd monomials(const Eigen::Vector3d &x, Eigen::Index n)
{
  Eigen::VectorXd all(8);
  all << 1., x[0], x[1], x[2], x[0] * x[2], x[1] * x[2], x[0] * x[1], x[0] * x[1] * x[2];
  return all.head(n);
}

Eigen::MatrixXd extrapolation(const ReferenceCell &cell)
{
  const Eigen::Index n = cell.samples.cols();
  Eigen::MatrixXd    at_samples(n, n), at_corners(n, cell.n_corners);
  for (Eigen::Index k = 0; k < n; ++k)
    at_samples.col(k) = monomials(cell.samples.col(k), n);
  for (Eigen::Index k = 0; k < cell.n_corners; ++k)
    at_corners.col(k) = monomials(cell.nodes.col(k), n);
  return at_samples.lu().solve(at_corners);
}

ReferenceCell make_cell(CellKind kind)
{
  const dealii::ReferenceCell shape = finite_element(kind).reference_cell();
  ReferenceCell               cell;
  cell.n_nodes   = static_cast<int>(finite_element(kind).n_dofs_per_cell());
  cell.n_corners = static_cast<int>(shape.n_vertices());
  cell.node_of_corner.resize(cell.n_corners);
  std::iota(cell.node_of_corner.begin(), cell.node_of_corner.end(), 0);
  if (kind == CellKind::hexahedron)
    cell.node_of_corner = {0, 1, 3, 2, 4, 5, 7, 6};
  cell.faces      = faces_of(shape);
  cell.nodes      = columns(finite_element(kind).get_unit_support_points());
  cell.samples    = columns(quadrature(kind, 2).get_points());
  cell.between    = corners_between(cell);
  cell.to_corners = extrapolation(cell);
  return cell;
}

} // namespace

const ReferenceCell &reference_cell(CellKind kind)
{
  static const ReferenceCell all[] = {make_cell(CellKind::tetrahedron), make_cell(CellKind::hexahedron),
                                      make_cell(CellKind::prism)};
  return all[std::size_t(kind)];
}

} // namespace gestell::fem
