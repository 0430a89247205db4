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
  expect_refusal([] { discretise(fem::Mesh(), free_steel()); }, "no cells");
  fem::Mesh inverted = box_mesh({1, 1, 1}, {1., 1., 1.});
  std::swap(inverted.cells[3][0], inverted.cells[3][1]);
  expect_refusal([&] { discretise(inverted, free_steel()); }, "tetrahedron 3 has the volume -0.16");
}

} // namespace

} // namespace gestell::test
