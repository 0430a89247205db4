#include "fem/assembly/affine_constraints.h"
#include "fem/assembly/elasticity.h"
#include "fem/assembly/rigid_motions.h"
#include "fem/assembly/supports.h"
#include "fem/recovery/discretisation.h"
#include "fem/values/nearest_name.h"
#include "tests/support/box_mesh.h"
#include "tests/support/statics.h"
#include "tests/support/test.h"

#include <unsupported/Eigen/KroneckerProduct>

namespace gestell::test
{
namespace
{

using fem::discretise;

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
  auto specification     = free_steel();
  specification.supports = {foundation("feet", {"z0"}, {1e8, 1e8, 2e8}, {1e3, 1e3, 1e3})};
  for (const auto coupling : {fem::InterfaceCoupling::average, fem::InterfaceCoupling::rigid})
  {
    specification.interfaces = {interface("top", {"z1"}, coupling)};
    const auto frame         = discretise(box_mesh({2, 2, 2}, {1., 1., 1.}, 0.2), specification);
    for (const auto *matrix : {&frame.M, &frame.B, &frame.C})
      EXPECT_EQ((Eigen::MatrixXd(*matrix) - Eigen::MatrixXd(*matrix).transpose()).cwiseAbs().maxCoeff(), 0.);
  }
}

TEST(Elasticity, RigidMotionsCostNothingAwayFromSupports)
{
  const fem::Mesh mesh  = box_mesh({4, 2, 2}, {2., 1., 1.}, 0.2);
  auto            clamp = free_steel();
  clamp.supports        = {clamped("foot", {"x0"})};
  const double rounding = 1e-14;
  using Coupling        = fem::InterfaceCoupling;
  for (const Coupling coupling : {Coupling::average, Coupling::rigid, Coupling::flexible})
  {
    clamp.interfaces = {interface("tip", {"x1"}, coupling)};
    EXPECT_LT(discretise(mesh, clamp).facts.rigid_energy, rounding) << int(coupling);
  }
  // One wrong entry is seen where no support holds, not at the support.
  const fem::QuadraticMesh   quadratic = fem::quadratic_mesh(mesh);
  const auto                 supports  = fem::find_supports(mesh, quadratic, clamp.supports);
  fem::MultipointConstraints constraints(quadratic.n_nodes());
  fem::hold(supports, constraints);
  const fem::AffineConstraints affine(constraints);
  const fem::CellMaterials     steel{{clamp.material}, std::vector<int>(mesh.n_cells(), 0)};
  fem::SparseMatrix            C       = fem::assemble(quadratic, steel, affine, fem::whole(quadratic, affine)).C;
  const Eigen::MatrixXd        motions = fem::rigid_coordinates(quadratic, {1., 0.5, 0.5}, affine, {});
  const auto                   share   = [&] { return fem::rigid_energy_share(C, motions, quadratic, affine); };
  EXPECT_LT(share(), rounding);
  const auto number_at = [&](double x)
  {
    const auto node = std::find_if(quadratic.points.begin(), quadratic.points.end(),
                                   [&](const fem::Point3 &point) { return std::abs(point[0] - x) < 0.1; });
    return affine.coordinate(3 * int(node - quadratic.points.begin()));
  };
  for (const double x : {0.25, 2.})
  {
    const int i = number_at(x);
    ASSERT_GE(i, 0);
    const double right = C.coeff(i, i);
    C.coeffRef(i, i) *= 1. + 1e-6;
    EXPECT_EQ(share() > 1e-10, x == 2.) << share();
    C.coeffRef(i, i) = right;
  }
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
  expect_refusal([&] { discretise(inverted, free_steel()); }, "tetrahedron 3 has a volume of -0.16");
}

constexpr double bar_length = 1.6, bar_width = 0.2, bar_height = 0.3, bar_area = bar_width * bar_height;

/// A bar along x whose first quarter is the solid "foot", the rest "column".
fem::Mesh bar_of_two_solids()
{
  fem::Mesh mesh = box_mesh({{8, 2, 2}}, {{bar_length, bar_width, bar_height}});
  mesh.solids    = {"foot", "column"};
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
  {
    double x = 0.;
    for (const int point : mesh.cells[c])
      x += 0.25 * mesh.points[point][0];
    mesh.cell_solid[c] = x > 0.25 * bar_length;
  }
  return mesh;
}

fem::FrameSpecification clamped_bar()
{
  auto specification        = free_steel();
  specification.material.nu = 0.;
  specification.supports    = {clamped("wall", {"x0"})};
  specification.interfaces  = {interface("tip", {"x1"}, fem::InterfaceCoupling::average)};
  return specification;
}

TEST(Materials, OfTwoSolidsAddTheirCompliancesAndWeights)
{
  // nu = 0: the field is linear in each part and meets the clamped end, so P2 holds it exactly.
  auto specification          = clamped_bar();
  specification.materials     = {{"column", {70e9, 0., 2700., "", "aluminium"}}};
  const auto            frame = fem::discretise(bar_of_two_solids(), specification);
  const int             tip   = frame.interfaces[0].coordinate[fem::ux];
  const Eigen::VectorXd q     = statics(frame, Eigen::VectorXd::Unit(frame.C.rows(), tip));
  const double          exact = (0.25 / 210e9 + 0.75 / 70e9) * bar_length / bar_area;
  EXPECT_NEAR(q[tip], exact, 1e-9 * exact);

  const double foot = 7850. * 0.25 * bar_length * bar_area, column = 2700. * 0.75 * bar_length * bar_area;
  EXPECT_NEAR(frame.mass, foot + column, 1e-12 * frame.mass);
  EXPECT_NEAR(frame.centre[0], bar_length * (0.125 * foot + 0.625 * column) / frame.mass, 1e-12);
}

TEST(Materials, FitByPatternTheLastCounts)
{
  auto specification      = clamped_bar();
  specification.materials = {{"*", {70e9, 0., 2700., ""}}, {"f??t", {110e9, 0., 7200., ""}}};
  EXPECT_NEAR(fem::discretise(bar_of_two_solids(), specification).mass,
              bar_length * bar_area * (0.25 * 7200. + 0.75 * 2700.), 1e-9);
}

TEST(Materials, OfUnknownSolidsOrImpossibleNumbersAreRefusedWithThePlace)
{
  auto specification      = clamped_bar();
  specification.materials = {{"colum", {70e9, 0., 2700., "press.toml:8: frame.materials.colum"}}};
  const auto refuse       = [&] { return refusal([&] { fem::discretise(bar_of_two_solids(), specification); }); };
  EXPECT_NE(refuse().find("press.toml:8: frame.materials.colum: there is no solid \"colum\"; the nearest names are "
                          "\"column\""),
            std::string::npos)
      << refuse();
  EXPECT_EQ(nearest_names("colum", {"all", "column", "all"}, "solid"), "the nearest names are \"column\", \"all\"");
  specification.materials = {{"column", {70e9, 0., -1., "press.toml:8"}}};
  EXPECT_NE(refuse().find("press.toml:8: density rho = -1"), std::string::npos);
}

using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(AffineConstraints, FollowTiesToFreeDisplacements)
{
  fem::MultipointConstraints constraints(3);
  constraints.held[1] = 1;
  constraints.tie(3, {{0, 0.5}, {1, 7.}}); // u3 = u0 / 2, as u1 is held
  constraints.tie(6, {{3, 4.}, {2, 1.}});  // u6 = 2 u0 + u2
  constraints.tie(7, {{1, 3.}});           // u7 = 0
  const fem::AffineConstraints affine(constraints);
  Eigen::VectorXd              u(9);
  u << 1., 0., 10., 0.5, 4., 5., 12., 0., 8.;
  Eigen::VectorXd q(5);
  q << 1., 10., 4., 5., 8.;
  EXPECT_LT((affine.expand(q) - u).norm(), 1e-14);
  EXPECT_THAT(affine.row(7), IsEmpty());
}

TEST(AffineConstraints, SumCellsAsProjectionsOfTheirSum)
{
  fem::MultipointConstraints constraints(3);
  constraints.held[1] = 1;
  constraints.tie(4, {{0, 0.3}, {8, -0.7}, {9, 1.5}});
  constraints.tie(6, {{4, 3.}, {2, 0.2}});
  constraints.measures.resize(1);
  const fem::AffineConstraints affine(constraints);
  const auto                   symmetric = [](int n) -> Eigen::MatrixXd
  {
    const Eigen::MatrixXd R = Eigen::MatrixXd::Random(n, n);
    return R + R.transpose();
  };
  const Eigen::MatrixXd C = symmetric(9), M = symmetric(3),
                        M_of_u   = Eigen::kroneckerProduct(M, Eigen::Matrix3d::Identity());
  const auto            nodes    = [](int) { return std::vector<int>{0, 1, 2}; };
  const auto            matrices = [&](int cell) -> fem::CellMatrices { return {cell * C, cell * M}; };
  const fem::MatrixSums sums     = affine.sum({{1, 2}, {0, 1, 2, 3, 4, 5, 6}}, nodes, matrices);
  for (const auto &[sum, of_cells] : {std::pair(&sums.C, &C), std::pair(&sums.M, &M_of_u)})
  {
    const Eigen::MatrixXd expected = affine.project(3. * of_cells->sparseView()), found = *sum;
    EXPECT_LT((found - expected).norm(), 1e-14 * expected.norm());
    EXPECT_EQ((found - found.transpose()).norm(), 0.) << "to the last bit";
  }
}

TEST(AffineConstraints, ThatLeadBackToThemselvesAreRefused)
{
  fem::MultipointConstraints constraints(2);
  constraints.tie(0, {{3, 1.}});
  constraints.tie(3, {{4, 1.}});
  constraints.tie(4, {{0, 1.}});
  EXPECT_THAT(refusal([&] { fem::AffineConstraints{constraints}; }), HasSubstr("tied to itself"));
}

} // namespace
} // namespace gestell::test
