#include "fem/elasticity.h"

#include <Eigen/LU>

#include <cmath>
#include <sstream>
#include <stdexcept>

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

void require_range(const Material &material, bool holds, const char *quantity, double value, const char *needed,
                   const char *remedy)
{
  if (holds)
    return;
  std::ostringstream message;
  message << (material.place.empty() ? "material" : material.place) << ": " << quantity << " = " << value << ", but "
          << needed << " is needed; " << remedy << ".";
  throw std::invalid_argument(message.str());
}

} // namespace

void require_valid(const Material &material)
{
  const auto &[E, nu, rho, place, name] = material;
  require_range(material, std::isfinite(E) && E > 0., "Young's modulus E", E, "E > 0 Pa", "steel has 210 GPa");
  require_range(material, std::isfinite(nu) && nu > -1. && nu < 0.5, "Poisson's ratio nu", nu, "-1 < nu < 0.5",
                "steel has 0.3; an incompressible material (0.5) locks these elements, take 0.49 at most");
  require_range(material, std::isfinite(rho) && rho > 0., "density rho", rho, "rho > 0 kg/m^3",
                "steel has 7850 kg/m^3");
}

CellStiffness cell_stiffness(const QuadraticMesh &mesh, int cell, const Material &material)
{
  const Eigen::Matrix3d     J         = jacobian(mesh, mesh.cells[cell]);
  const Eigen::Matrix3d     inverse   = J.inverse();
  const double              lambda    = material.E * material.nu / ((1. + material.nu) * (1. - 2. * material.nu));
  const double              mu        = material.E / (2. * (1. + material.nu));
  const ReferenceIntegrals &integrals = reference_integrals();
  const Eigen::Matrix3d     scaled    = std::abs(J.determinant()) * inverse.transpose();

  CellStiffness C;
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

CellMass cell_mass(const QuadraticMesh &mesh, int cell, const Material &material)
{
  const double determinant = std::abs(jacobian(mesh, mesh.cells[cell]).determinant());
  return material.rho * determinant * reference_integrals().mass;
}

BlockMatrix assemble_stiffness(const QuadraticMesh &mesh, const CellMaterials &materials)
{
  BlockMatrix C(3, mesh.n_nodes(), mesh.cells);
  for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
    C.add(mesh.cells[cell], cell_stiffness(mesh, static_cast<int>(cell), materials[cell]).data());
  C.finish();
  return C;
}

BlockMatrix assemble_mass(const QuadraticMesh &mesh, const CellMaterials &materials)
{
  BlockMatrix M(1, mesh.n_nodes(), mesh.cells);
  for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
    M.add(mesh.cells[cell], cell_mass(mesh, static_cast<int>(cell), materials[cell]).data());
  M.finish();
  return M;
}

} // namespace gestell::fem
