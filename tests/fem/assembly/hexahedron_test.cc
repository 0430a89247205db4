#include "fem/assembly/elasticity.h"
#include "fem/assembly/quadratic_mesh.h"
#include "fem/assembly/rigid_motions.h"
#include "fem/recovery/discretisation.h"
#include "tests/support/box_mesh.h"
#include "tests/support/brick_mesh.h"
#include "tests/support/lowest_modes.h"
#include "tests/support/statics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace gestell::test
{

namespace
{

const fem::Material steel = free_steel().material;

fem::CellMaterials all_of(const fem::QuadraticMesh &mesh, const fem::Material &material)
{
  return {{material}, std::vector<int>(mesh.n_cells(), 0)};
}

Eigen::VectorXd field(const fem::QuadraticMesh &mesh, const std::function<Eigen::Vector3d(const Eigen::Vector3d &)> &u)
{
  Eigen::VectorXd result(3 * mesh.n_nodes());
  for (int i = 0; i < mesh.n_nodes(); ++i)
    result.segment<3>(3 * i) = u(Eigen::Map<const Eigen::Vector3d>(mesh.points[i].data()));
  return result;
}

Eigen::SparseMatrix<double> free_matrix(const fem::BlockMatrix &A, int n_nodes)
{
  return fem::AffineConstraints(fem::MultipointConstraints(n_nodes)).project(A);
}

TEST(Hexahedra, PassThePatchTestHoweverDistorted)
{
  // A linear displacement has constant stress: no force on inner nodes, and the energy V eps : C : eps.
  const auto      quadratic = fem::quadratic_mesh(brick_mesh({3, 3, 3}, {1., 2., 0.5}, 0.25));
  const auto      C = free_matrix(fem::assemble_stiffness(quadratic, all_of(quadratic, steel)), quadratic.n_nodes());
  Eigen::Matrix3d H;
  H << 1., 0.4, -0.2, 0.1, -0.5, 0.3, 0.6, 0.2, 0.8;
  const Eigen::VectorXd u = field(quadratic, [&](const Eigen::Vector3d &x) { return H * x; });
  const Eigen::VectorXd f = C * u;
  for (int i = 0; i < quadratic.n_nodes(); ++i)
  {
    const auto &x = quadratic.points[i];
    if (x[0] > 1e-9 && x[0] < 1. - 1e-9 && x[1] > 1e-9 && x[1] < 2. - 1e-9 && x[2] > 1e-9 && x[2] < 0.5 - 1e-9)
    {
      EXPECT_LT(f.segment<3>(3 * i).norm(), 1e-10 * f.cwiseAbs().maxCoeff());
    }
  }
  const Eigen::Matrix3d eps    = 0.5 * (H + H.transpose());
  const double          lambda = steel.E * steel.nu / ((1. + steel.nu) * (1. - 2. * steel.nu));
  const double          mu     = steel.E / (2. * (1. + steel.nu));
  const double          energy = lambda * eps.trace() * eps.trace() + 2. * mu * eps.squaredNorm();
  EXPECT_NEAR(u.dot(f), energy, 1e-10 * energy);
}

TEST(Hexahedra, LetRigidMotionsPassWithoutEnergyAndWeighWhatTheyShould)
{
  const auto quadratic = fem::quadratic_mesh(brick_mesh({2, 3, 2}, {1., 2., 0.5}, 0.2));
  const auto C         = free_matrix(fem::assemble_stiffness(quadratic, all_of(quadratic, steel)), quadratic.n_nodes());
  const auto M         = free_matrix(fem::assemble_mass(quadratic, all_of(quadratic, steel)), quadratic.n_nodes());
  const Eigen::MatrixXd R = fem::rigid_displacements(quadratic, Eigen::Vector3d::Zero());
  EXPECT_LT((R.transpose() * (C * R)).norm(), 1e-10 * C.diagonal().maxCoeff());
  const Eigen::MatrixXd m = R.transpose() * (M * R);
  EXPECT_NEAR(m(0, 0), 7850., 1e-9 * 7850.);
  // Inertia about z through the origin, (a^2 + b^2) / 3 per mass.
  EXPECT_NEAR(m(5, 5), 7850. * (1. + 4.) / 3., 1e-9 * 7850.);
  EXPECT_EQ((C - Eigen::SparseMatrix<double>(C.transpose())).norm(), 0.) << "symmetric to the last bit";
}

TEST(Hexahedra, BendExactlyUnderAnEndMomentWithoutPoissonsEffect)
{
  // As the same test of tetrahedra; it needs areas, averaged and clamped surfaces of quadrilaterals to be right.
  constexpr double length = 2., width = 0.2, height = 0.25, moment = 1e5;
  auto             specification = free_steel();
  specification.material.nu      = 0.;
  specification.supports         = {clamped("wall", {"x0"})};
  specification.interfaces       = {interface("tip", {"x1"}, fem::InterfaceCoupling::average)};
  specification.cuts             = {{"middle", {0.9, 0., 0.}, {1., 0., 0.}, ""}};
  const auto frame               = fem::discretise(brick_mesh({4, 1, 1}, {length, width, height}), specification);

  const auto           &tip = frame.interfaces[0].coordinate;
  const double          EI  = 210e9 * width * std::pow(height, 3) / 12.;
  const Eigen::VectorXd q   = statics(frame, moment * Eigen::VectorXd::Unit(frame.C.rows(), tip[fem::ry]));
  EXPECT_NEAR(q[tip[fem::ry]], moment * length / EI, 1e-9 * moment * length / EI);
  EXPECT_NEAR(q[tip[fem::uz]], -moment * length * length / (2. * EI), 1e-9 * moment * length * length / (2. * EI));

  const Eigen::VectorXd pull = statics(frame, 1000. * Eigen::VectorXd::Unit(frame.C.rows(), tip[fem::ux]));
  EXPECT_NEAR(output(frame, "cut.middle").on_q.dot(pull), 1000., 1e-6);
}

TEST(Hexahedra, CarryTheirWeightIntoAFoundation)
{
  auto specification          = free_steel();
  specification.supports      = {foundation("floor", {"z0"}, {1e8, 1e8, 2e8}, {1e4, 1e4, 3e4})};
  const auto            frame = fem::discretise(brick_mesh({2, 2, 2}, {1., 1., 1.}), specification);
  const Eigen::VectorXd q     = statics(frame, -9.81 * frame.acceleration_load.col(2));
  EXPECT_NEAR(output(frame, "support.floor.z").on_q.dot(q), 9.81 * 7850., 1e-6 * 9.81 * 7850.);
  EXPECT_NEAR(frame.translations.col(2).dot(frame.B * frame.translations.col(2)), 3e4, 1e-6);
}

fem::FrameMatrices thick_plate(int n, int n_z)
{
  fem::FrameSpecification specification;
  specification.material = {200e9, 0.3, 8000., "plate"};
  specification.supports = {clamped("x sides", {"x0", "x1"}, {{false, true, true}}),
                            clamped("y sides", {"y0", "y1"}, {{true, false, true}})};
  return fem::discretise(brick_mesh({n, n, n_z}, {10., 10., 1.}), specification);
}

TEST(Hexahedra, OneLayerOfTheThicknessGivesAPlateItsFrequency)
{
  // 45.897 Hz after three-dimensional elasticity; cells 2.5 times as wide as thick.
  const double f = lowest_modes(thick_plate(4, 1), 1).frequency_hz[0];
  EXPECT_GT(f, 45.897);
  EXPECT_LT(f, 1.01 * 45.897);
}

TEST(Hexahedra, FrequenciesFallWithTheFourthPowerOfTheCellSize)
{
  const double exact = std::sqrt(200e9 / 2.6 / 8000.) / 20.; // shear in the plane, the second mode
  const auto   error = [&](int n)
  {
    const Modes modes = lowest_modes(thick_plate(n, 1), 6);
    double      least = 1e9;
    for (int j = 0; j < 6; ++j)
      if (std::abs(modes.frequency_hz[j] / exact - 1.) < std::abs(least))
        least = modes.frequency_hz[j] / exact - 1.;
    return least;
  };
  const double coarse = error(2), fine = error(4);
  EXPECT_GT(fine, 0.);
  EXPECT_NEAR(std::log2(coarse / fine), 4., 0.35);
}

TEST(Hexahedra, ThatFoldAreRefused)
{
  auto mesh      = brick_mesh({1, 1, 1}, {1., 1., 1.});
  mesh.points[7] = {-1., -1., -1.};
  EXPECT_NE(refusal([&] { fem::quadratic_mesh(mesh); }).find("folds"), std::string::npos);
}

} // namespace

} // namespace gestell::test
