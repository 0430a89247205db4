#include "fem/assembly/elasticity.h"
#include "fem/assembly/rigid_motions.h"
#include "fem/recovery/discretisation.h"
#include "tests/support/box_mesh.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include <cmath>

namespace gestell::test
{

namespace
{

using fem::discretise;

TEST(Elasticity, PatchTestALinearFieldStrainsEveryCellAlikeAndLeavesInnerNodesFree)
{
  const fem::Mesh          mesh      = box_mesh({3, 3, 3}, {1., 0.8, 1.2}, 0.25);
  const fem::QuadraticMesh quadratic = fem::quadratic_mesh(mesh);
  const auto               frame     = discretise(mesh, free_steel());
  Eigen::Matrix3d          gradient;
  gradient << 1e-3, 2e-4, -3e-4, 5e-4, -7e-4, 1e-4, 2e-4, 6e-4, 4e-4;

  Eigen::VectorXd u(frame.C.rows());
  for (int i = 0; i < quadratic.n_nodes(); ++i)
    u.segment<3>(3 * i) = gradient * Eigen::Map<const Eigen::Vector3d>(quadratic.points[i].data());
  const Eigen::VectorXd force = frame.C * u;

  std::vector<char> outer(quadratic.n_nodes(), 0);
  for (const auto &face : quadratic.skin)
    for (const int node : face)
      outer[node] = 1;
  double largest_inner = 0.;
  for (int i = 0; i < quadratic.n_nodes(); ++i)
    if (!outer[i])
      largest_inner = std::max(largest_inner, force.segment<3>(3 * i).norm());
  EXPECT_LT(largest_inner, 1e-12 * force.cwiseAbs().maxCoeff());

  // Energy of the constant strain eps: V/2 (lambda tr(eps)^2 + 2 mu eps : eps).
  const Eigen::Matrix3d strain = 0.5 * (gradient + gradient.transpose());
  const double          lambda = 210e9 * 0.3 / (1.3 * 0.4), mu = 210e9 / 2.6;
  const double          energy = 0.5 * 0.96 * (lambda * std::pow(strain.trace(), 2) + 2. * mu * strain.squaredNorm());
  EXPECT_NEAR(0.5 * u.dot(force) / energy, 1., 1e-12);
}

TEST(Elasticity, SixRigidMotionsCostNoEnergyAndNoOtherDoes)
{
  const auto frame = discretise(box_mesh({2, 1, 1}, {1., 0.5, 0.4}, 0.), free_steel());
  for (int k = 0; k < 6; ++k)
  {
    const Eigen::VectorXd z = frame.rigid_motions.col(k);
    EXPECT_LT((frame.C * z).cwiseAbs().maxCoeff(), 1e-13 * (frame.C.cwiseAbs() * z.cwiseAbs()).maxCoeff()) << k;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> spectrum(Eigen::MatrixXd(frame.C), Eigen::EigenvaluesOnly);
  EXPECT_LT(std::abs(spectrum.eigenvalues()[5]), 1e-12 * spectrum.eigenvalues()[frame.C.rows() - 1]);
  EXPECT_GT(spectrum.eigenvalues()[6], 1e-6 * spectrum.eigenvalues()[frame.C.rows() - 1]);
}

TEST(Elasticity, RigidMotionsHaveTheKineticEnergyOfTheRigidBody)
{
  const double          a = 1., b = 0.5, c = 0.4, mass = 7850. * a * b * c;
  const auto            frame   = discretise(box_mesh({2, 2, 1}, {a, b, c}, 0.2), free_steel());
  const Eigen::MatrixXd inertia = frame.rigid_motions.transpose() * (frame.M * frame.rigid_motions);
  Eigen::VectorXd       exact(6);
  exact << mass, mass, mass, mass / 12. * (b * b + c * c), mass / 12. * (a * a + c * c), mass / 12. * (a * a + b * b);

  EXPECT_NEAR(frame.mass, mass, 1e-12 * mass);
  EXPECT_LT((inertia - Eigen::MatrixXd(exact.asDiagonal())).cwiseAbs().maxCoeff(), 1e-12 * mass);
  EXPECT_NEAR(frame.centre[0], a / 2., 1e-12);
  EXPECT_LT((frame.acceleration_load - frame.M * frame.translations).cwiseAbs().maxCoeff(), 1e-12 * mass);
}

TEST(Elasticity, MatricesAreSymmetricToTheLastBit)
{
  auto specification       = free_steel();
  specification.interfaces = {interface("top", {"z1"}, fem::InterfaceCoupling::average)};
  specification.supports   = {foundation("feet", {"z0"}, {1e8, 1e8, 2e8}, {1e3, 1e3, 1e3})};
  const auto frame         = discretise(box_mesh({2, 2, 2}, {1., 1., 1.}, 0.2), specification);
  for (const auto *matrix : {&frame.M, &frame.B, &frame.C})
    EXPECT_EQ((Eigen::MatrixXd(*matrix) - Eigen::MatrixXd(*matrix).transpose()).cwiseAbs().maxCoeff(), 0.);
}

TEST(Elasticity, GravityOnClampedNodesIsNotLost)
{
  auto specification     = free_steel();
  specification.supports = {clamped("foot", {"z0"})};
  const auto frame       = discretise(box_mesh({2, 2, 2}, {1., 1., 1.}), specification);
  // Load of the free nodes: all of their mass, though M holds only their part of the coupling with clamped nodes.
  const auto free = discretise(box_mesh({2, 2, 2}, {1., 1., 1.}), free_steel());
  EXPECT_LT(frame.acceleration_load.col(2).sum(), free.mass);
  EXPECT_GT(frame.acceleration_load.col(2).sum(), (frame.M * frame.translations.col(2)).sum());
}

TEST(Elasticity, ImpossibleMaterialsAreRefusedWithPlaceValueAndNeed)
{
  const fem::Mesh mesh   = box_mesh({1, 1, 1}, {1., 1., 1.});
  const auto      refuse = [&](double E, double nu, double rho)
  {
    auto specification     = free_steel();
    specification.material = {E, nu, rho, "press.toml:17: material.steel"};
    return refusal([&] { discretise(mesh, specification); });
  };
  EXPECT_EQ(refuse(210e9, 0.3, 7850.), "");
  EXPECT_NE(refuse(-1., 0.3, 7850.).find("press.toml:17: material.steel: Young's modulus E = -1, but E > 0"),
            std::string::npos);
  EXPECT_NE(refuse(0., 0.3, 7850.).find("E = 0"), std::string::npos);
  EXPECT_NE(refuse(210e9, 0.5, 7850.).find("nu = 0.5, but -1 < nu < 0.5"), std::string::npos);
  EXPECT_NE(refuse(210e9, -1., 7850.).find("nu = -1"), std::string::npos);
  EXPECT_NE(refuse(210e9, 0.3, 0.).find("rho = 0"), std::string::npos);
  EXPECT_NE(refuse(std::nan(""), 0.3, 1.).find("E = nan"), std::string::npos);
}

TEST(Elasticity, MeshesWithoutVolumeAreRefused)
{
  EXPECT_NE(refusal([] { discretise(fem::Mesh(), free_steel()); }).find("no cells"), std::string::npos);
  fem::Mesh inverted = box_mesh({1, 1, 1}, {1., 1., 1.});
  std::swap(inverted.cells[3][0], inverted.cells[3][1]);
  EXPECT_NE(refusal([&] { discretise(inverted, free_steel()); }).find("tetrahedron 3 has the volume -0.16"),
            std::string::npos);
}

} // namespace

} // namespace gestell::test
