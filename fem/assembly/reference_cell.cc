#include "fem/assembly/reference_cell.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_wedge_p.h>

#include <Eigen/LU>

#include <algorithm>
#include <numeric>
#include <utility>

namespace gestell::fem
{

namespace
{

using Element    = dealii::FiniteElement<3>;
using Quadrature = dealii::Quadrature<3>;
using Point      = dealii::Point<3>;

ReferenceCell::Points tabulate(const Element &element, const std::vector<Point> &points,
                               const std::vector<double> &weights = {})
{
  const auto            n = Eigen::Index(element.dofs_per_cell), n_points = Eigen::Index(points.size());
  ReferenceCell::Points result;
  result.xi.resize(3, n_points);
  result.weight = Eigen::Map<const Eigen::VectorXd>(weights.data(), Eigen::Index(weights.size()));
  result.N.resize(n, n_points);
  result.dN.resize(n, 3 * n_points);
  for (Eigen::Index k = 0; k < n_points; ++k)
    for (Eigen::Index a = 0; a < n; ++a)
    {
      const auto slope = element.shape_grad(static_cast<unsigned int>(a), points[k]);
      result.N(a, k)   = element.shape_value(static_cast<unsigned int>(a), points[k]);
      for (int d = 0; d < 3; ++d)
      {
        result.xi(d, k)         = points[k][d];
        result.dN(a, 3 * k + d) = slope[d];
      }
    }
  return result;
}

ReferenceCell::Points tabulate(const Element &element, const Quadrature &rule)
{
  return tabulate(element, rule.get_points(), rule.get_weights());
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
                                       middle += cell.nodes.xi.col(corner) / static_cast<double>(set.size());
                                     return (middle - cell.nodes.xi.col(a)).norm() < 1e-9;
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
  const Eigen::Index n = cell.samples.size();
  Eigen::MatrixXd    at_samples(n, n), at_corners(n, cell.n_corners);
  for (Eigen::Index k = 0; k < n; ++k)
    at_samples.col(k) = monomials(cell.samples.xi.col(k), n);
  for (Eigen::Index k = 0; k < cell.n_corners; ++k)
    at_corners.col(k) = monomials(cell.nodes.xi.col(k), n);
  return at_samples.lu().solve(at_corners);
}

ReferenceCell tabulated(const Element &element, const Quadrature &rule, const Quadrature &finer,
                        const std::vector<Point> &samples)
{
  ReferenceCell cell;
  cell.n_nodes   = static_cast<int>(element.dofs_per_cell);
  cell.n_corners = static_cast<int>(element.reference_cell().n_vertices());
  cell.node_of_corner.resize(cell.n_corners);
  std::iota(cell.node_of_corner.begin(), cell.node_of_corner.end(), 0);
  cell.faces      = faces_of(element.reference_cell());
  cell.nodes      = tabulate(element, element.get_unit_support_points());
  cell.between    = corners_between(cell);
  cell.rule       = tabulate(element, rule);
  cell.finer      = tabulate(element, finer);
  cell.samples    = tabulate(element, samples);
  cell.to_corners = extrapolation(cell);
  return cell;
}

/// Rules of Witherden and Vincent with parameter n integrate degree 2 n - 1 exactly: masses are of degree 4.
ReferenceCell tetrahedron()
{
  constexpr double                          near = 0.58541019662496845, far = 0.1381966011250105; // rule of degree 2
  const dealii::QWitherdenVincentSimplex<3> rule(3);
  return tabulated(dealii::FE_SimplexP<3>(2), rule, rule,
                   {{far, far, far}, {near, far, far}, {far, near, far}, {far, far, near}});
}

ReferenceCell hexahedron()
{
  ReferenceCell cell =
      tabulated(dealii::FE_Q<3>(2), dealii::QGauss<3>(3), dealii::QGauss<3>(4), dealii::QGauss<3>(2).get_points());
  cell.node_of_corner = {0, 1, 3, 2, 4, 5, 7, 6};
  return cell;
}

/// A rule of the triangle times one of Gauss.
Quadrature across(const dealii::Quadrature<2> &triangle, const dealii::Quadrature<1> &line)
{
  std::vector<Point>  points;
  std::vector<double> weights;
  for (unsigned int k = 0; k < line.size(); ++k)
    for (unsigned int i = 0; i < triangle.size(); ++i)
    {
      points.emplace_back(triangle.point(i)[0], triangle.point(i)[1], line.point(k)[0]);
      weights.push_back(triangle.weight(i) * line.weight(k));
    }
  return {points, weights};
}

/// Gradients of quadratics are linear on a triangle: three points inside carry them.
ReferenceCell prism()
{
  const std::vector<dealii::Point<2>>       inside = {{1. / 6., 1. / 6.}, {2. / 3., 1. / 6.}, {1. / 6., 2. / 3.}};
  const dealii::QWitherdenVincentSimplex<2> triangle(3);
  const dealii::Quadrature<2>               three(inside, std::vector<double>(3, 1. / 6.));
  return tabulated(dealii::FE_WedgeP<3>(2), across(triangle, dealii::QGauss<1>(3)),
                   across(triangle, dealii::QGauss<1>(4)), across(three, dealii::QGauss<1>(2)).get_points());
}

} // namespace

const ReferenceCell &reference_cell(CellKind kind)
{
  static const ReferenceCell four = tetrahedron(), eight = hexahedron(), six = prism();
  return kind == CellKind::tetrahedron ? four : kind == CellKind::hexahedron ? eight : six;
}

} // namespace gestell::fem
