#include "fem/assembly/elasticity.h"

#include <numeric>

namespace gestell::fem
{

namespace
{

/// A diag(weight) A^T, symmetric to the last bit.
Eigen::MatrixXd weighted_squares(const Eigen::MatrixXd &A, const Eigen::VectorXd &weight)
{
  Eigen::MatrixXd product                        = (A * weight.asDiagonal()) * A.transpose();
  product.triangularView<Eigen::StrictlyUpper>() = product.transpose();
  return product;
}

std::vector<int> nodes_of(const QuadraticMesh &mesh, int cell)
{
  return {mesh.nodes(cell), mesh.nodes(cell) + mesh.n_nodes_of(cell)};
}

double first_lame(const Material &material)
{
  return material.E * material.nu / ((1. + material.nu) * (1. - 2. * material.nu));
}

double shear_modulus(const Material &material)
{
  return material.E / (2. * (1. + material.nu));
}

std::vector<int> up_to(int n)
{
  std::vector<int> numbers(n);
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

} // namespace

Eigen::MatrixXd stiffness_matrix(const PointValues &cell, const Material &material)
{
  const Eigen::Index n = cell.N.rows(), n_points = cell.N.cols();
  Eigen::MatrixXd    gradients(3 * n, n_points);
  for (Eigen::Index p = 0; p < n_points; ++p)
    gradients.col(p) = cell.dN.middleCols<3>(3 * p).transpose().reshaped();
  const Eigen::MatrixXd D      = weighted_squares(gradients, cell.weight); // blocks int grad N_a grad N_b^T dV
  const double          lambda = first_lame(material), mu = shear_modulus(material);
  Eigen::MatrixXd       C(3 * n, 3 * n);
  for (Eigen::Index b = 0; b < n; ++b)
    for (Eigen::Index a = 0; a < n; ++a)
    {
      const Eigen::Matrix3d own = D.block<3, 3>(3 * a, 3 * b);
      C.block<3, 3>(3 * a, 3 * b) =
          lambda * own + mu * own.transpose() + mu * own.trace() * Eigen::Matrix3d::Identity();
    }
  return C;
}

Eigen::MatrixXd geometric_stiffness(const PointValues &cell, const Material &material,
                                    const Eigen::Ref<const Eigen::Matrix3Xd> &u)
{
  const Eigen::Index n = cell.N.rows(), n_points = cell.N.cols();
  const double       lambda = first_lame(material), mu = shear_modulus(material);
  Eigen::MatrixXd    S = Eigen::MatrixXd::Zero(n, n); // int grad N_a . sigma grad N_b dV
  for (Eigen::Index p = 0; p < n_points; ++p)
  {
    const auto            dN    = cell.dN.middleCols<3>(3 * p);
    const Eigen::Matrix3d H     = u * dN.topRows(u.cols());
    const Eigen::Matrix3d sigma = lambda * H.trace() * Eigen::Matrix3d::Identity() + mu * (H + H.transpose());
    S += cell.weight[p] * dN * sigma * dN.transpose();
  }
  S.triangularView<Eigen::StrictlyUpper>() = S.transpose();
  Eigen::MatrixXd K                        = Eigen::MatrixXd::Zero(3 * n, 3 * n);
  for (int d = 0; d < 3; ++d)
    K(Eigen::seqN(d, n, 3), Eigen::seqN(d, n, 3)) = S;
  return K;
}

Eigen::MatrixXd tangent_stiffness(const PointValues &at, const QuadraticMesh &mesh, const CellMaterials &materials,
                                  int cell)
{
  Eigen::MatrixXd C = stiffness_matrix(at, materials[cell]);
  if (materials.u0.size() > 0)
    C += geometric_stiffness(at, materials[cell], materials.u0(Eigen::all, nodes_of(mesh, cell)));
  return C;
}

Eigen::MatrixXd mass_matrix(const PointValues &cell, double rho)
{
  return rho * weighted_squares(cell.N, cell.weight);
}

MatrixSums assemble(const QuadraticMesh &mesh, const CellMaterials &materials, const AffineConstraints &affine,
                    const Extent &extent)
{
  CellValues values(mesh, CellPoints::rule);
  return affine.sum(
      extent, [&](int cell) { return nodes_of(mesh, cell); },
      [&](int cell) -> CellMatrices
      {
        const PointValues &at = values.of(cell);
        return {stiffness_matrix(at, materials[cell]), mass_matrix(at, materials[cell].rho)};
      });
}

SparseMatrix assemble_geometric(const QuadraticMesh &mesh, const CellMaterials &materials,
                                const AffineConstraints &affine, const Extent &extent)
{
  CellValues values(mesh, CellPoints::rule);
  return affine
      .sum(
          extent, [&](int cell) { return nodes_of(mesh, cell); },
          [&](int cell) -> CellMatrices
          {
            const PointValues &at = values.of(cell);
            return {geometric_stiffness(at, materials[cell], materials.u0(Eigen::all, nodes_of(mesh, cell))),
                    Eigen::MatrixXd::Zero(at.N.rows(), at.N.rows())};
          })
      .C;
}

Extent whole(const QuadraticMesh &mesh, const AffineConstraints &affine)
{
  return {up_to(mesh.n_cells()), up_to(affine.n_coordinates())};
}

} // namespace gestell::fem
