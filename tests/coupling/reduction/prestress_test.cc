// Geometric stiffness: its invariants, buckling loads and frequencies of bars and plates under load.

#include "coupling/frame/frame_recipe.h"
#include "coupling/plugin/frame/prestressed.h"
#include "fem/recovery/raised_matrices.h"
#include "tests/support/box_mesh.h"
#include "tests/support/brick_mesh.h"
#include "tests/support/lowest_modes.h"
#include "tests/support/statics.h"
#include "tests/support/test.h"

#include <cmath>

namespace gestell::test
{
namespace
{

constexpr double E = 210e9, rho = 7850.;

fem::SurfaceLoad force_on(const std::string &surface, const fem::Vector3 &force)
{
  return {{surface}, force, 0., "scene.toml:7"};
}

fem::Discretisation stressed(const fem::Mesh &mesh, const fem::FrameSpecification &specification)
{
  return coupling::discretised(mesh, specification, "", {});
}

/// The number in the statement on the buckling factor.
double buckling_factor(const fem::Discretisation &frame)
{
  const std::string head = "the buckling factor is ";
  for (const std::string &statement : frame.matrices.statements)
    if (const auto at = statement.find(head); at != std::string::npos)
      return std::stod(statement.substr(at + head.size()));
  return INFINITY;
}

/// A block on soft ground with a coupled face on top, a counterweight above it, and its own weight.
fem::FrameSpecification heavy_block(fem::InterfaceCoupling coupling = fem::InterfaceCoupling::rigid)
{
  auto s       = free_steel();
  s.supports   = {foundation("ground", {"z0"}, {1e3, 1e3, 1e7})}; // next to no friction
  s.interfaces = {interface("head", {"z1"}, coupling)};
  fem::AttachedMass m;
  m.name      = "motor";
  m.mass      = 3000.;
  m.interface = "head";
  m.centre    = fem::Vector3{0.5, 0.4, 2.5};
  s.masses    = {m};
  s.prestress = fem::Prestress{{0., 0., -9.81}, {}, 1., false, {}, "scene.toml:5"};
  return s;
}

class GeometricStiffness
    : public ::testing::TestWithParam<fem::Mesh (*)(const std::array<int, 3> &, const std::array<double, 3> &, double)>
{
};

TEST_P(GeometricStiffness, IsSymmetricAndTurnsWithTheWorkOfTheWeight)
{
  // Translations move no stress; a rotation theta about a horizontal axis lowers the weight m g at the height h by
  // m g h theta^2 / 2, reactions in the plane of the ground do no work.
  const std::array<double, 3> size{1., 0.8, 1.5};
  const double                moment = 9.81 * (rho * size[0] * size[1] * size[2] * size[2] / 2. + 3000. * 2.5);
  for (const auto coupling : {fem::InterfaceCoupling::rigid, fem::InterfaceCoupling::average})
    for (const double height : {1.5, 2.2}) // of the node, whose face is at 1.5 m
    {
      auto specification                   = heavy_block(coupling);
      specification.interfaces[0].position = fem::Vector3{0.5, 0.4, height};
      const auto            frame          = stressed(GetParam()({2, 2, 3}, size, 0.2), specification);
      const Eigen::MatrixXd K = frame.geometric, &R = frame.matrices.rigid_motions;
      EXPECT_EQ((K - K.transpose()).cwiseAbs().maxCoeff(), 0.);
      const double rounding = 1e-12 * K.cwiseAbs().rowwise().sum().maxCoeff();
      EXPECT_LT((K * R.leftCols<3>()).cwiseAbs().maxCoeff(), rounding);
      for (const int axis : {3, 4})
        EXPECT_NEAR(R.col(axis).dot(K * R.col(axis)), -moment, 1e-8 * moment) << axis << ", " << height;
    }
}

INSTANTIATE_TEST_SUITE_P(Cells, GeometricStiffness, ::testing::Values(box_mesh, brick_mesh, prism_mesh));

constexpr double length = 1., side = 0.05;

/// A bar along x without Poisson contraction.
fem::FrameSpecification bar(const std::vector<fem::Support> &supports, const std::vector<fem::SurfaceLoad> &loads)
{
  auto s        = free_steel();
  s.material.nu = 0.;
  s.supports    = supports;
  s.prestress   = fem::Prestress{{}, loads, 1., false, {}, "scene.toml:5"};
  return s;
}

/// Euler's load of a bar with the buckling length l, lowered by shear (Engesser) and by the stress beside E:
/// P_E (1 - P_E / (E A)) / (1 + P_E / (kappa mu A)).
double euler(double l)
{
  const double P = M_PI * M_PI * E * std::pow(side, 4) / 12. / (l * l);
  return P * (1. - P / (E * side * side)) / (1. + P / (5. / 6. * E / 2. * side * side));
}

TEST(Prestress, BucklesAColumnUnderEulersLoad)
{
  const double P     = 1e5;
  const auto   frame = stressed(brick_mesh({16, 1, 1}, {length, side, side}),
                                bar({clamped("wall", {"x0"})}, {force_on("x1", {-P, 0., 0.})}));
  EXPECT_NEAR(buckling_factor(frame), euler(2. * length) / P, 1e-3 * euler(2. * length) / P);
}

TEST(Prestress, ShiftsTheFrequencyOfAPinnedBarWithItsForce)
{
  // Mode and buckling shape are one sine: omega^2 = omega_0^2 (1 + P / P_crit).
  const auto frequency = [](double P)
  {
    auto s = bar({clamped("ends", {"x0", "x1"}, {{false, true, true}}), foundation("along", {"x0"}, {1e3, 0., 0.})},
                 {force_on("x0", {-P, 0., 0.}), force_on("x1", {P, 0., 0.})});
    const auto mesh = brick_mesh({16, 1, 1}, {length, side, side});
    if (P == 0.)
      s.prestress.reset();
    return lowest_modes(stressed(mesh, s).matrices, 2).frequency_hz[1]; // the first is along the bar
  };
  const double f_0 = frequency(0.);
  for (const double share : {-0.75, 3.})
    EXPECT_NEAR(frequency(share * euler(length)), f_0 * std::sqrt(1. + share), 1e-3 * f_0) << share;
}

TEST(Prestress, BucklesAPlateBetweenSlidingWallsAsAStrip)
{
  // With u_y = 0 at y0 and y1, and no rotation at x0:  N = pi^2 D / 4 a^2, D = E t^3 / 12 (1 - nu^2), less shear as in
  // euler().
  constexpr double t = 0.02, nu = 0.3, p = 1e5;
  auto             s = bar({clamped("middle", {"x0"}, {{true, false, false}}),
                            clamped("walls", {"y0", "y1"}, {{false, true, false}}), foundation("across", {"x0"}, {0., 0., 1e3})},
                           {{{"x1"}, {}, p, ""}});
  s.material.nu      = nu;
  const double N     = M_PI * M_PI * E * t * t * t / 12. / (1. - nu * nu) / 4.;
  const double exact = N / (1. + N / (5. / 6. * E / 2. / (1. + nu) * t)) / (p * t);
  const auto   frame = stressed(brick_mesh({12, 1, 1}, {1., 0.5, t}), s);
  EXPECT_NEAR(buckling_factor(frame), exact, 1e-3 * exact);

  // The same in elements of degree three, their stiffness about the same state.
  const auto raised = fem::raised_matrices(frame, s);
  const auto f      = lowest_modes(frame.matrices, 2).frequency_hz[1];
  EXPECT_NEAR(lowest_modes(raised, 2).frequency_hz[1], f, 1e-3 * f);
}

TEST(Prestress, KeepsTheBalanceOfSupportsAndLoads)
{
  // A uniform acceleration moves no stress: the supports carry the weight of the stressed frame too.
  auto s                        = heavy_block();
  s.supports                    = {clamped("ground", {"z0"})};
  const auto              frame = stressed(brick_mesh({2, 2, 3}, {1., 0.8, 1.5}), s);
  const Eigen::VectorXd   f     = frame.matrices.acceleration_load.col(0);
  const Eigen::VectorXd   q     = statics(frame.matrices, f);
  const fem::FrameOutput &x     = output(frame.matrices, "support.ground.x");
  EXPECT_NEAR(x.on_q.dot(q) + x.under_acceleration[0], -frame.matrices.mass, 1e-8 * frame.matrices.mass);
}

TEST(Prestress, ChangesNothingWithoutLoads)
{
  auto s = heavy_block();
  s.prestress.reset();
  const auto mesh = box_mesh({2, 2, 2}, {1., 0.8, 1.5});
  const auto a = stressed(mesh, s).matrices, b = fem::discretise(mesh, s);
  EXPECT_EQ((Eigen::MatrixXd(a.C) - Eigen::MatrixXd(b.C)).cwiseAbs().maxCoeff(), 0.);
  s.cad = __FILE__;
  for (const coupling::Ingredient &own : coupling::recipe_of(s, {}))
    EXPECT_EQ(own.name.find("prestress"), std::string::npos);
}

TEST(Prestress, IsRefusedWhereItHasNoMeaning)
{
  const auto mesh   = brick_mesh({4, 1, 1}, {length, side, side});
  const auto refuse = [&](const fem::FrameSpecification &s) { return refusal([&] { stressed(mesh, s); }); };
  const auto wall   = clamped("wall", {"x0"});
  EXPECT_NE(refuse(bar({wall}, {force_on("x1", {-2. * euler(2. * length), 0., 0.})})).find("beyond buckling"),
            std::string::npos);
  EXPECT_NE(refuse(bar({wall}, {})).find("loads are zero"), std::string::npos);
  EXPECT_NE(refuse(bar({}, {force_on("x1", {1., 0., 0.})})).find("add a support"), std::string::npos);
  EXPECT_NE(refuse(bar({wall}, {force_on("end", {1., 0., 0.})})).find("\"end\""), std::string::npos);
  EXPECT_EQ(buckling_factor(stressed(mesh, bar({wall}, {force_on("x1", {1e5, 0., 0.})}))), INFINITY);
}

} // namespace
} // namespace gestell::test
