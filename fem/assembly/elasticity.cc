#include "fem/assembly/elasticity.h"

#include "fem/assembly/reference_cell.h"
#include "fem/assembly/reference_integrals.h"

#include <Eigen/LU>

#include <cmath>
#include <type_traits>

namespace gestell::fem
{

namespace
{

/// dx/dxi of the affine map from the reference tetrahedron.
Eigen::Matrix3d jacobian(const QuadraticMesh &mesh, const std::array<int, 10> &nodes)
{
  Eigen::Matrix3d J;
  for (int k = 0; k < 3; ++k)
    for (int d = 0; d < 3; ++d)
      J(d, k) = mesh.points[nodes[k + 1]][d] - mesh.points[nodes[0]][d];
  return J;
}

CellStiffness tetrahedron_stiffness(const QuadraticMesh &mesh, int cell, const Material &material)
{
  const Eigen::Matrix3d     J         = jacobian(mesh, mesh.cells[cell]);
  const Eigen::Matrix3d     inverse   = J.inverse();
  const double              lambda    = material.E * material.nu / ((1. + material.nu) * (1. - 2. * material.nu));
  const double              mu        = material.E / (2. * (1. + material.nu));
  const ReferenceIntegrals &integrals = reference_integrals();
  const Eigen::Matrix3d     scaled    = std::abs(J.determinant()) * inverse.transpose();

  CellStiffness C(30, 30);
  for (int a = 0; a < 10; ++a)
    for (int b = a; b < 10; ++b)
    {
      // D_ij = int N_a,i N_b,j dV
      Eigen::Matrix3d D = scaled * integrals.gradients[a][b] * inverse;
      if (a == b)
        D = 0.5 * (D + D.transpose()).eval();
      const Eigen::Matrix3d block = lambda * D + mu * D.transpose() + mu * D.trace() * Eigen::Matrix3d::Identity();
      C.block<3, 3>(3 * a, 3 * b) = block;
      C.block<3, 3>(3 * b, 3 * a) = block.transpose();
    }
  return C;
}

/// By quadrature, for isoparametric cells of n nodes.
template <int n>
CellStiffness isoparametric_stiffness(const Eigen::Matrix<double, 3, n> &X, const ReferenceCell::Points &points,
                                      const Material &material)
{
  const double lambda = material.E * material.nu / ((1. + material.nu) * (1. - 2. * material.nu));
  const double mu     = material.E / (2. * (1. + material.nu));

  CellStiffness C = CellStiffness::Zero(3 * n, 3 * n);
  for (int k = 0; k < points.size(); ++k)
  {
    const Eigen::Map<const Eigen::Matrix<double, n, 3>> dN(points.dN.data() + 3 * n * k);
    const Eigen::Matrix3d                               J      = X * dN;
    const Eigen::Matrix<double, n, 3>                   G      = dN * J.inverse();
    const double                                        volume = points.weight[k] * J.determinant();
    for (int a = 0; a < n; ++a)
      for (int b = a; b < n; ++b)
      {
        const Eigen::Matrix3d D = volume * G.row(a).transpose() * G.row(b);
        C.block<3, 3>(3 * a, 3 * b) += lambda * D + mu * D.transpose() + mu * D.trace() * Eigen::Matrix3d::Identity();
      }
  }
  for (int a = 0; a < n; ++a)
    for (int b = a; b < n; ++b)
      C.block<3, 3>(3 * b, 3 * a) = C.block<3, 3>(3 * a, 3 * b).transpose().eval();
  for (int i = 0; i < 3 * n; ++i) // the blocks on the diagonal too, to the last bit
    for (int j = 0; j < i; ++j)
      C(i, j) = C(j, i);
  return C;
}

template <int n>
CellMass isoparametric_mass(const Eigen::Matrix<double, 3, n> &X, const ReferenceCell::Points &points,
                            const Material &material)
{
  CellMass M = CellMass::Zero(n, n);
  for (int k = 0; k < points.size(); ++k)
  {
    const Eigen::Map<const Eigen::Matrix<double, n, 3>> dN(points.dN.data() + 3 * n * k);
    const Eigen::Map<const Eigen::Matrix<double, n, 1>> N(points.N.data() + n * k);
    M += material.rho * points.weight[k] * (X * dN).determinant() * N * N.transpose();
  }
  return 0.5 * (M + M.transpose());
}

template <typename Matrix>
BlockMatrix assemble(int block_size, const QuadraticMesh &mesh, const Matrix &matrix)
{
  BlockMatrix result(block_size, mesh.n_nodes(), mesh.lists());
  for (int cell = 0; cell < mesh.n_cells(); ++cell)
    result.add(mesh.nodes(cell), mesh.n_nodes_of(cell), matrix(cell).data());
  result.finish();
  return result;
}

/// Calls function(n) with the number of nodes as a constant.
template <typename Function>
auto with_nodes_of(CellKind kind, const Function &function)
{
  if (kind == CellKind::hexahedron)
    return function(std::integral_constant<int, 27>());
  if (kind == CellKind::prism)
    return function(std::integral_constant<int, 18>());
  return function(std::integral_constant<int, 10>());
}

bool is_straight_tetrahedron(const QuadraticMesh &mesh, int cell)
{
  return mesh.kind(cell) == CellKind::tetrahedron && !mesh.is_curved(cell);
}

} // namespace

CellStiffness cell_stiffness(const QuadraticMesh &mesh, int cell, const Material &material)
{
  if (is_straight_tetrahedron(mesh, cell))
    return tetrahedron_stiffness(mesh, cell, material);
  const CellKind kind = mesh.kind(cell);
  return with_nodes_of(kind,
                       [&](auto n) {
                         return isoparametric_stiffness<decltype(n)::value>(positions(mesh, cell),
                                                                            reference_cell(kind).rule, material);
                       });
}

CellMass cell_mass(const QuadraticMesh &mesh, int cell, const Material &material)
{
  if (is_straight_tetrahedron(mesh, cell))
    return material.rho * std::abs(jacobian(mesh, mesh.cells[cell]).determinant()) * reference_integrals().mass;
  const CellKind kind = mesh.kind(cell);
  return with_nodes_of(
      kind, [&](auto n)
      { return isoparametric_mass<decltype(n)::value>(positions(mesh, cell), reference_cell(kind).rule, material); });
}

BlockMatrix assemble_stiffness(const QuadraticMesh &mesh, const CellMaterials &materials)
{
  return assemble(3, mesh, [&](int cell) { return cell_stiffness(mesh, cell, materials[cell]); });
}

BlockMatrix assemble_mass(const QuadraticMesh &mesh, const CellMaterials &materials)
{
  return assemble(1, mesh, [&](int cell) { return cell_mass(mesh, cell, materials[cell]); });
}

} // namespace gestell::fem
