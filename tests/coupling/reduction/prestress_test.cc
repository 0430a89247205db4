// Geometric stiffness: its invariants, buckling loads and frequencies of bars and plates under load.

#include "coupling/algebra/dense_modes.h"
#include "coupling/frame/frame_recipe.h"
#include "coupling/plugin/frame/prestressed.h"
#include "fem/recovery/raised_matrices.h"
#include "tests/support/box_mesh.h"
#include "tests/support/brick_mesh.h"
#include "tests/support/frame_folder.h"
#include "tests/support/lowest_modes.h"
#include "tests/support/statics.h"
#include "tests/support/test.h"

#include <Eigen/Geometry>

#include <algorithm>
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

/// The number after these words of a statement.
double factor_in(const std::vector<std::string> &statements, const std::string &head)
{
  for (const std::string &statement : statements)
    if (const auto at = statement.find(head); at != std::string::npos)
      return std::stod(statement.substr(at + head.size()));
  return INFINITY;
}

double buckling_factor(const fem::Discretisation &frame)
{
  return factor_in(frame.matrices.statements, "the buckling factor is ");
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

/// With its vertical edges bent by 2 %.
fem::Mesh curved_mesh(const std::array<int, 3> &n, const std::array<double, 3> &size, double)
{
  fem::Mesh mesh = box_mesh(n, size);
  for (const auto &cell : mesh.cells)
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < a; ++b)
      {
        const auto [i, j] = std::minmax(cell[a], cell[b]);
        const auto &x = mesh.points[i], &y = mesh.points[j];
        if (x[0] == y[0] && x[1] == y[1] && (x[0] == 0. || x[0] == size[0]))
          mesh.middles[{i, j}] = {x[0] + 0.02 * std::abs(x[2] - y[2]), x[1], 0.5 * (x[2] + y[2])};
      }
  return mesh;
}

/// Plates as swept ones: prisms beside hexahedra.
fem::Mesh swept_mesh(const std::array<int, 3> &n, const std::array<double, 3> &size, double)
{
  return filled_mesh(n, size,
                     [](int i, int, int) { return i == 0 ? fem::CellKind::prism : fem::CellKind::hexahedron; });
}

INSTANTIATE_TEST_SUITE_P(Cells, GeometricStiffness,
                         ::testing::Values(box_mesh, brick_mesh, prism_mesh, swept_mesh, curved_mesh));

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
  EXPECT_NEAR(frame.matrices.facts.buckling_factor.value(), buckling_factor(frame), 1e-3 * buckling_factor(frame));
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

TEST(Prestress, IsProportionalToItsFactor)
{
  const auto mesh     = brick_mesh({2, 2, 3}, {1., 0.8, 1.5}, 0.2);
  auto       s        = heavy_block();
  const auto whole    = stressed(mesh, s);
  s.prestress->factor = 0.5;
  const auto half     = stressed(mesh, s);
  s.prestress.reset();
  const Eigen::MatrixXd C = stressed(mesh, s).matrices.C, difference = 2. * half.matrices.C - whole.matrices.C - C;
  EXPECT_LT(difference.cwiseAbs().maxCoeff(), 1e-12 * C.cwiseAbs().maxCoeff());
  EXPECT_NEAR(buckling_factor(half), 2. * buckling_factor(whole), 2e-3); // of its digits
}

TEST(Prestress, TurnsAndScalesWithTheFrame)
{
  // Turned by Q and l times as large under l^2 times the forces: equal stresses, frequencies / l, the same factor.
  const double          l = 3.;
  const Eigen::Matrix3d Q = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1., 2., -0.5).normalized()).matrix();
  const Eigen::Vector3d F(-1e5, 2e3, -1e4);
  const auto            of = [&](const Eigen::Matrix3d &A, double scale)
  {
    fem::Mesh mesh = box_mesh({8, 1, 1}, {length, side, side});
    for (fem::Point3 &x : mesh.points)
      Eigen::Map<Eigen::Vector3d>(x.data()) = scale * A * Eigen::Map<Eigen::Vector3d>(x.data()).eval();
    const Eigen::Vector3d turned = scale * scale * A * F;
    auto                  frame  = bar({clamped("wall", {"x0"})}, {force_on("x1", {turned[0], turned[1], turned[2]})});
    return stressed(mesh, frame);
  };
  const auto given = of(Eigen::Matrix3d::Identity(), 1.), moved = of(Q, l);
  EXPECT_EQ(buckling_factor(moved), buckling_factor(given)); // to four digits
  const Eigen::VectorXd f = lowest_modes(given.matrices, 4).frequency_hz,
                        g = lowest_modes(moved.matrices, 4).frequency_hz;
  EXPECT_LT((l * g - f).cwiseQuotient(f).cwiseAbs().maxCoeff(), 1e-8);
}

class PrestressInParts : public FrameFolder // parts have a cache of their own
{
protected:
  /// A pressed column with a node at its end and a mass on it.
  static fem::FrameSpecification column(double P)
  {
    auto s                    = bar({clamped("wall", {"x0"})}, {force_on("x1", {-P, 0.1 * P, 0.})});
    s.material.nu             = 0.3;
    s.interfaces              = {interface("end", {"x1"}, fem::InterfaceCoupling::rigid)};
    s.masses                  = {{"motor", 4., Eigen::Matrix3d::Identity(), {}, "end", {}, {}, ""}};
    s.prestress->acceleration = {0., 0., -9.81};
    s.rayleigh_stiffness      = 1e-5;
    s.place                   = "scene.toml:2: frame";
    return s;
  }

  static coupling::ReducedFrame in_parts(const fem::Mesh &mesh, const fem::FrameSpecification &s, int n_parts,
                                         int n_modes)
  {
    coupling::PartsCall        call{s.rayleigh_mass, s.rayleigh_stiffness, s.place, 1, {}, s.prestress->place};
    fem::Discretisation        frame = fem::discretise_for_parts(mesh, s);
    const auto                 parts = frame.mesh_error->parts(n_parts, s.place);
    coupling::ReductionOptions options;
    options.n_modes = n_modes;
    return coupling::reduce_prestressed_in_parts(frame, parts, mesh, s, options, call).frame;
  }
};

TEST_F(PrestressInParts, HasTheStiffnessAndFrequenciesOfTheFrameInOnePiece)
{
  const auto                 mesh  = box_mesh({12, 1, 1}, {length, side, side});
  const auto                 s     = column(0.6 * euler(2. * length));
  const auto                 whole = stressed(mesh, s);
  coupling::ReductionOptions options;
  options.n_modes = 120; // of 621, and as many of each part: those left out count for less than 1e-6
  const auto one  = coupling::reduce_frame(whole.matrices, options);
  for (const int n_parts : {2, 3})
  {
    const auto parts = in_parts(mesh, s, n_parts, options.n_modes);
    for (int j = 0; j < 4; ++j)
      EXPECT_NEAR(parts.frequencies_hz[j], one.frequencies_hz[j], 1e-6 * one.frequencies_hz[j]) << n_parts << ' ' << j;
    const Eigen::MatrixXd C = one.C.topLeftCorner(6, 6), B = one.B.topLeftCorner(6, 6);
    EXPECT_LT((parts.C.topLeftCorner(6, 6) - C).norm(), 1e-8 * C.norm());
    EXPECT_LT((parts.B.topLeftCorner(6, 6) - B).norm(), 1e-6 * B.norm());

    // The buckling factor in the reduced coordinates is one of Ritz.
    const double exact = buckling_factor(whole), bound = factor_in(parts.statements, "the buckling factor is at most ");
    EXPECT_GT(bound, (1. - 1e-3) * exact); // of its digits
    EXPECT_LT(bound, (1. + 1e-3) * exact);
  }
}

TEST_F(PrestressInParts, IsRefusedBeyondBuckling)
{
  const auto mesh = box_mesh({12, 1, 1}, {length, side, side});
  for (const double share : {1.1, 30.}) // of the frame, and of its parts with their interfaces fixed
  {
    const auto        s       = column(share * euler(2. * length));
    const std::string message = refusal([&] { in_parts(mesh, s, 2, 10); }),
                      start   = "scene.toml:5: prestress beyond buckling: the frame buckles at ";
    ASSERT_EQ(message.rfind(start, 0), 0u) << message;
    EXPECT_NE(message.find(" times these loads or less, and needs more than 1"), std::string::npos) << message;
    const std::string whole = refusal([&] { stressed(mesh, s); }); // about the same stresses, with all DOFs
    ASSERT_EQ(whole.rfind(start, 0), 0u) << whole;
    const double bound = std::stod(message.substr(start.size())), exact = std::stod(whole.substr(start.size()));
    EXPECT_GT(bound, (1. - 1e-3) * exact); // of its digits
    EXPECT_LT(bound, (1. + 1e-2) * exact);
  }
  auto loose = column(1e4);
  loose.supports.clear();
  expect_refusal([&] { in_parts(mesh, loose, 2, 10); }, "scene.toml:5: the supports leave the frame free to move");
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
  const auto        mesh   = brick_mesh({4, 1, 1}, {length, side, side});
  const auto        refuse = [&](const fem::FrameSpecification &s) { return refusal([&] { stressed(mesh, s); }); };
  const auto        wall   = clamped("wall", {"x0"});
  const std::string beyond = refuse(bar({wall}, {force_on("x1", {-2. * euler(2. * length), 0., 0.})}));
  EXPECT_NE(beyond.find("scene.toml:5: prestress beyond buckling: the frame buckles at 0.5"), std::string::npos)
      << beyond;
  EXPECT_NE(beyond.find("times these loads, and needs more than 1; reduce them or their 'factor', or stiffen the "
                        "frame"),
            std::string::npos)
      << beyond;
  EXPECT_NE(refuse(bar({wall}, {})).find("loads are zero"), std::string::npos);
  EXPECT_NE(refuse(bar({}, {force_on("x1", {1., 0., 0.})})).find("add a support"), std::string::npos);
  EXPECT_NE(refuse(bar({wall}, {force_on("end", {1., 0., 0.})})).find("\"end\""), std::string::npos);
  const auto pulled = stressed(mesh, bar({wall}, {force_on("x1", {1e5, 0., 0.})}));
  EXPECT_EQ(buckling_factor(pulled), INFINITY);
  EXPECT_EQ(pulled.matrices.facts.buckling_factor, INFINITY);
}

} // namespace
} // namespace gestell::test
