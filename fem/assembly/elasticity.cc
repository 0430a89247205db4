#include "fem/assembly/elasticity.h"

#include "fem/assembly/reference_cell.h"
#include "fem/mesh/hexahedron.h"

#include <Eigen/LU>

#include <cmath>

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

/// By quadrature, for cells of n nodes whose geometry is interpolated as their displacements are.
template <int n, typename Points>
CellStiffness isoparametric_stiffness(const Eigen::Matrix<double, 3, n> &X, const Points &points,
                                      const Material &material)
{
  const double lambda = material.E * material.nu / ((1. + material.nu) * (1. - 2. * material.nu));
  const double mu     = material.E / (2. * (1. + material.nu));

  CellStiffness C = CellStiffness::Zero(3 * n, 3 * n);
  for (const auto &point : points)
  {
    const Eigen::Matrix3d             J      = X * point.dN;
    const Eigen::Matrix<double, n, 3> G      = point.dN * J.inverse();
    const double                      volume = point.weight * J.determinant();
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

template <int n, typename Points>
CellMass isoparametric_mass(const Eigen::Matrix<double, 3, n> &X, const Points &points, const Material &material)
{
  CellMass M = CellMass::Zero(n, n);
  for (const auto &point : points)
  {
    const Eigen::Matrix3d J = X * point.dN;
    M += material.rho * point.weight * J.determinant() * point.N * point.N.transpose();
  }
  return 0.5 * (M + M.transpose());
}

template <std::size_t n, typename Matrix>
BlockMatrix assemble(int block_size, const QuadraticMesh &mesh, const std::vector<std::array<int, n>> &cells,
                     const Matrix &matrix)
{
  BlockMatrix result(block_size, mesh.n_nodes(), cells);
  for (std::size_t cell = 0; cell < cells.size(); ++cell)
    result.add(cells[cell], matrix(static_cast<int>(cell)).data());
  result.finish();
  return result;
}

template <typename Matrix>
BlockMatrix assemble(int block_size, const QuadraticMesh &mesh, const Matrix &matrix)
{
  return mesh.hexahedra.empty() ? assemble(block_size, mesh, mesh.cells, matrix)
                                : assemble(block_size, mesh, mesh.hexahedra, matrix);
}

} // namespace

CellStiffness cell_stiffness(const QuadraticMesh &mesh, int cell, const Material &material)
{
  if (!mesh.hexahedra.empty())
    return isoparametric_stiffness<hexahedron::n_nodes>(positions(mesh, cell), hexahedron::quadrature(3), material);
  if (mesh.is_curved(cell))
    return isoparametric_stiffness<10>(positions(mesh, cell), reference_integrals().tetrahedron, material);
  return tetrahedron_stiffness(mesh, cell, material);
}

CellMass cell_mass(const QuadraticMesh &mesh, int cell, const Material &material)
{
  if (!mesh.hexahedra.empty())
    return isoparametric_mass<hexahedron::n_nodes>(positions(mesh, cell), hexahedron::quadrature(3), material);
  if (mesh.is_curved(cell))
    return isoparametric_mass<10>(positions(mesh, cell), reference_integrals().tetrahedron, material);
  const double determinant = std::abs(jacobian(mesh, mesh.cells[cell]).determinant());
  return material.rho * determinant * reference_integrals().mass;
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
