#include "fem/assembly/affine_constraints.h"
#include "fem/assembly/interfaces.h"
#include "fem/assembly/quadratic_mesh.h"
#include "fem/assembly/rigid_motions.h"
#include "fem/assembly/surface_patch.h"
#include "fem/recovery/discretisation.h"
#include "tests/support/box_mesh.h"
#include "tests/support/lowest_modes.h"
#include "tests/support/statics.h"
#include "tests/support/test.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace gestell::test
{
namespace
{

using fem::discretise;
using fem::InterfaceCoupling;

constexpr auto rigid   = InterfaceCoupling::rigid;
constexpr auto average = InterfaceCoupling::average;

/// A block clamped at its foot, its top face coupled to the node "top".
fem::FrameSpecification block(InterfaceCoupling coupling, std::optional<fem::Vector3> position = {})
{
  auto specification                   = free_steel();
  specification.supports               = {clamped("foot", {"z0"})};
  specification.interfaces             = {interface("top", {"z1"}, coupling)};
  specification.interfaces[0].position = position;
  return specification;
}

fem::Mesh block_mesh(int n = 3)
{
  return box_mesh({n, n, n}, {1., 0.8, 1.5}, 0.2);
}

/// 6 x 6 flexibility of the node, H = (C^-1)_11.
Eigen::MatrixXd flexibility(const fem::FrameMatrices &frame)
{
  Eigen::MatrixXd H(6, 6);
  for (int j = 0; j < 6; ++j)
  {
    const Eigen::VectorXd q = statics(frame, Eigen::VectorXd::Unit(frame.C.rows(), frame.interfaces[0].coordinate[j]));
    for (int i = 0; i < 6; ++i)
      H(i, j) = q[frame.interfaces[0].coordinate[i]];
  }
  return H;
}

void expect_six_rigid_motions(const fem::FrameMatrices &frame)
{
  const Eigen::MatrixXd energy = frame.rigid_motions.transpose() * (frame.C * frame.rigid_motions);
  const Eigen::MatrixXd magnitude =
      frame.rigid_motions.cwiseAbs().transpose() * (frame.C.cwiseAbs() * frame.rigid_motions.cwiseAbs());
  EXPECT_LT(energy.cwiseAbs().maxCoeff(), 1e-12 * magnitude.maxCoeff());
}

using Coupling = ::testing::TestWithParam<InterfaceCoupling>;

TEST_P(Coupling, KeepsTheSixRigidMotionsOfAFreeFrameFreeOfEnergy)
{
  auto specification     = block(GetParam(), fem::Vector3{0.3, 2., -1.});
  specification.supports = {};
  const auto frame       = discretise(block_mesh(), specification);
  expect_six_rigid_motions(frame);

  // and nothing else became free: the seventh eigenvalue is elastic
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> spectrum(Eigen::MatrixXd(frame.C), Eigen::EigenvaluesOnly);
  EXPECT_GT(spectrum.eigenvalues()[6], 1e3 * std::abs(spectrum.eigenvalues()[5]));
}

TEST_P(Coupling, KeepsMassAndInertiaOfRigidMotions)
{
  auto specification            = block(GetParam());
  specification.supports        = {};
  const auto            mesh    = block_mesh();
  const auto            coupled = discretise(mesh, specification), plain = discretise(mesh, free_steel());
  const Eigen::MatrixXd expected = plain.rigid_motions.transpose() * (plain.M * plain.rigid_motions);
  const Eigen::MatrixXd found    = coupled.rigid_motions.transpose() * (coupled.M * coupled.rigid_motions);
  EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 1e-11 * plain.mass);
}

TEST_P(Coupling, LeavesMPositiveDefiniteAndCTooWhenHeld)
{
  const auto frame = discretise(block_mesh(), block(GetParam()));
  EXPECT_EQ((Eigen::LLT<Eigen::MatrixXd>(Eigen::MatrixXd(frame.M)).info()), Eigen::Success);
  EXPECT_EQ((Eigen::LLT<Eigen::MatrixXd>(Eigen::MatrixXd(frame.C)).info()), Eigen::Success);
}

TEST_P(Coupling, DefaultsToTheCentroidOfTheArea)
{
  const auto frame = discretise(block_mesh(), block(GetParam()));
  EXPECT_NEAR(frame.interfaces[0].position[0], 0.5, 1e-12);
  EXPECT_NEAR(frame.interfaces[0].position[1], 0.4, 1e-12);
  EXPECT_NEAR(frame.interfaces[0].position[2], 1.5, 1e-12);
}

TEST_P(Coupling, MovesItsNodeAsARigidArmDoes)
{
  // H at x0 from H at the centroid:  p0 = T p_c, forces transposed.
  const fem::Mesh       mesh = block_mesh();
  const fem::Vector3    arm{{0.7, -0.2, 2.5}};
  const Eigen::MatrixXd H_c = flexibility(discretise(mesh, block(GetParam())));
  const Eigen::MatrixXd H_0 = flexibility(discretise(mesh, block(GetParam(), arm)));
  Eigen::MatrixXd       T   = Eigen::MatrixXd::Identity(6, 6);
  T.topRows(3)              = fem::rigid_motions_of_point(arm, Eigen::Vector3d(0.5, 0.4, 1.5));
  EXPECT_LT((H_0 - T * H_c * T.transpose()).cwiseAbs().maxCoeff(), 1e-9 * H_0.cwiseAbs().maxCoeff());
}

TEST(AverageCoupling, StaysRegularOnFewOrUnfavourablyPlacedNodes)
{
  // One triangle of six nodes; and a strip a hundred times longer than wide, which hardly tells its own twist.
  fem::Mesh few = box_mesh({2, 2, 2}, {1., 0.8, 1.5}), narrow = box_mesh({12, 1, 2}, {1., 0.01, 0.3});
  few.surfaces["z1"]    = {few.surfaces["z1"].front()};
  const auto expect_six = [](const fem::Mesh &mesh)
  {
    auto specification     = block(average);
    specification.supports = {};
    const auto frame       = discretise(mesh, specification);
    expect_six_rigid_motions(frame);
    EXPECT_NEAR(frame.rigid_motions.col(0).dot(frame.M * frame.rigid_motions.col(0)), frame.mass, 1e-9 * frame.mass);
  };
  expect_six(few);
  expect_six(narrow);

  // and its flexibility is that of the same traction on the uncoupled surface, checked by reciprocity and definiteness
  const Eigen::MatrixXd H = flexibility(discretise(narrow, block(average)));
  EXPECT_LT((H - H.transpose()).norm(), 1e-8 * H.norm());
  EXPECT_GT((Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(0.5 * (H + H.transpose())).eigenvalues()[0]), 0.);
}

/// A block with the point of its top nearest to a position.
fem::FrameSpecification point_block(const fem::Vector3 &position, double radius = 0.)
{
  auto specification                 = block(InterfaceCoupling::point, position);
  specification.interfaces[0].radius = radius;
  return specification;
}

TEST(PointCoupling, StandsWhereTheSurfaceIsNearest)
{
  const auto at = [](const fem::Vector3 &position)
  { return Eigen::Vector3d(discretise(block_mesh(), point_block(position)).interfaces[0].position.data()); };
  EXPECT_LT((at({0.31, 0.22, 4.}) - Eigen::Vector3d(0.31, 0.22, 1.5)).norm(), 1e-12) << "above the face";
  EXPECT_LT((at({-3., 0.22, 1.5}) - Eigen::Vector3d(0., 0.22, 1.5)).norm(), 1e-12) << "beside it";
  EXPECT_LT((at({2., 3., 0.}) - Eigen::Vector3d(1., 0.8, 1.5)).norm(), 1e-12) << "beyond a corner";
}

TEST(PointCoupling, HasSixRigidBodyModesThatCostNoEnergyTogether)
{
  auto specification     = point_block({0.31, 0.22, 1.5});
  specification.supports = {};
  const auto frame       = discretise(block_mesh(), specification);
  expect_six_rigid_motions(frame);
}

TEST(PointCoupling, WithARadiusThatHoldsTheWholeSurfaceIsItsAverage)
{
  const fem::Vector3    centre{0.5, 0.4, 1.5};
  const Eigen::MatrixXd point = flexibility(discretise(block_mesh(), point_block(centre, 5.))),
                        whole = flexibility(discretise(block_mesh(), block(average)));
  EXPECT_LT((point - whole).norm(), 1e-9 * whole.norm());
}

TEST(PointCoupling, IsSofterTheSmallerItsSurface)
{
  const auto softness = [&](double radius, int n)
  {
    const auto frame = discretise(block_mesh(n), point_block({0.5, 0.4, 1.5}, radius));
    const int  uz    = frame.interfaces[0].coordinate[fem::uz];
    return statics(frame, Eigen::VectorXd::Unit(frame.C.rows(), uz))[uz];
  };
  EXPECT_GT(softness(0.25, 4), softness(0.45, 4));
  EXPECT_GT(softness(0., 4), 1.1 * softness(0., 2)) << "without a radius it depends on the mesh";
  const std::string message = refusal([] { discretise(block_mesh(), point_block({0.5, 0.4, 1.5}, 1e-3)); });
  EXPECT_NE(message.find("interface \"top\": no triangle of its surface"), std::string::npos) << message;
}

TEST(Couplings, OfAPadOnAPlateAreRigidStiffestPointSoftest)
{
  // A plate of 400 x 300 x 20 mm, clamped at one edge, with a pad of 100 x 100 mm in its middle.  The rigid pad
  // stiffens the plate itself, the others leave it its own frequency.  The figures stand in
  // docs/how_to/supports_and_interfaces.md.
  fem::Mesh         mesh = box_mesh({8, 6, 1}, {0.4, 0.3, 0.02});
  std::vector<int> &pad  = mesh.surfaces["pad"];
  for (const int triangle : mesh.surfaces["z1"])
  {
    const auto &corners = mesh.skin[triangle];
    if (std::all_of(corners.begin(), corners.end(),
                    [&](int i)
                    {
                      const auto &x = mesh.points[i];
                      return x[0] > 0.149 && x[0] < 0.251 && x[1] > 0.099 && x[1] < 0.201;
                    }))
      pad.push_back(triangle);
  }
  const auto with = [&](InterfaceCoupling coupling)
  {
    auto specification                   = block(coupling, fem::Vector3{0.2, 0.15, 0.02});
    specification.supports               = {clamped("edge", {"x0"})};
    specification.interfaces[0].surfaces = {"pad"};
    return discretise(mesh, specification);
  };
  const fem::FrameMatrices frames[3] = {with(rigid), with(average), with(InterfaceCoupling::point)};
  Eigen::MatrixXd          H[3];
  double                   f[3];
  for (int k = 0; k < 3; ++k)
  {
    H[k] = flexibility(frames[k]);
    f[k] = lowest_modes(frames[k], 1).frequency_hz[0];
    std::ostringstream figures;
    figures << "N/um " << 1e-6 / H[k](2, 2) << ", kN m/mrad " << 1e-6 / H[k](3, 3) << " " << 1e-6 / H[k](4, 4)
            << ", Hz " << f[k];
    RecordProperty("coupling_" + std::to_string(k), figures.str());
  }
  for (int i = 0; i < 6; ++i)
  {
    EXPECT_LT(H[0](i, i), H[1](i, i)) << i;
    EXPECT_LT(H[1](i, i), H[2](i, i)) << i;
  }
  EXPECT_GT(f[0], 1.01 * f[1]);
  EXPECT_NEAR(f[1], f[2], 1e-9 * f[1]) << "neither constrains the plate";
}

INSTANTIATE_TEST_SUITE_P(Both, Coupling, ::testing::Values(rigid, average),
                         [](const auto &kind) { return kind.param == rigid ? "Rigid" : "Average"; });

TEST(RigidCoupling, MovesEverySkinPointOfItsSurfaceWithTheNode)
{
  const auto  frame   = discretise(block_mesh(), block(rigid, fem::Vector3{0.2, 0.1, 1.9}));
  const auto &picture = frame.picture;
  for (int motion = 0; motion < 6; ++motion)
  {
    const Eigen::VectorXd u =
        picture.displacement * Eigen::VectorXd::Unit(frame.C.rows(), frame.interfaces[0].coordinate[motion]);
    for (std::size_t i = 0; i < picture.points.size(); ++i)
      if (picture.points[i][2] == 1.5)
      {
        const Eigen::Vector3d expected =
            fem::rigid_motions_of_point(picture.points[i], frame.interfaces[0].position).col(motion);
        EXPECT_LT((u.segment<3>(3 * i) - expected).norm(), 1e-14);
      }
  }
}

TEST(AverageCoupling, NodeIsTheAreaMeanAndTheBestRotationOfTheSurface)
{
  // Without support q2 is arbitrary.  A quadratic field on the whole block is represented exactly; its mean over the
  // face z = c [0, a] x [0, b] and its best rotation are known:  u = (x y, 0, x^2)
  //   mean  (a b / 4, 0, a^2 / 3),   rotation about y from u_z = x^2:  -a,   about z from u_x = x y:  see below.
  const double               a = 1., b = 0.8;
  const fem::Mesh            mesh      = block_mesh(5); // several groups of nodes
  const auto                 quadratic = fem::quadratic_mesh(mesh);
  fem::MultipointConstraints constraints(quadratic.n_nodes());
  const auto                 specification = block(average);
  const auto                 coupled = fem::couple_patches(mesh, quadratic, specification.interfaces, constraints);
  fem::tie_interfaces(coupled, quadratic, constraints);
  const fem::AffineConstraints affine(constraints);

  Eigen::VectorXd u(3 * quadratic.n_nodes());
  for (int i = 0; i < quadratic.n_nodes(); ++i)
  {
    const auto &x       = quadratic.points[i];
    u.segment<3>(3 * i) = Eigen::Vector3d(x[0] * x[1], 0., x[0] * x[0]);
  }
  Eigen::VectorXd q(affine.n_coordinates());
  for (int i = 0; i < u.size(); ++i)
    if (affine.coordinate(i) >= 0)
      q[affine.coordinate(i)] = u[i];
  for (std::size_t k = 0; k < constraints.measures.size(); ++k)
  {
    double &inner = q[affine.coordinate(constraints.first_new() + static_cast<int>(k))];
    inner         = 0.;
    for (const auto &[displacement, weight] : constraints.measures[k])
      inner += weight * u[displacement];
  }
  ASSERT_GT(constraints.measures.size(), 6u) << "one group only";
  // Rotation about the normal: moment of u_x = x y about the centroid, -int (y - b/2) x y dA = -a^2 b^3 / 24, over the
  // polar moment a b (a^2 + b^2) / 12.  About y: -int (x - a/2) x^2 dA = -a^4 b / 12 over a^3 b / 12.
  Eigen::VectorXd exact(6);
  exact << a * b / 4., 0., a * a / 3., 0., -a, -a * b * b / (2. * (a * a + b * b));
  for (int k = 0; k < 6; ++k)
    q[affine.coordinate(constraints.first_new() + k)] = exact[k];

  EXPECT_LT((affine.expand(q) - u).cwiseAbs().maxCoeff(), 1e-11);
}

TEST(AverageCoupling, GivesNoStiffnessRigidCouplingDoes)
{
  // Bounds: holding the surface together cannot soften, and averaging leaves the free frame's own compliance.
  const fem::Mesh       mesh = block_mesh();
  const Eigen::MatrixXd H_r  = flexibility(discretise(mesh, block(rigid))),
                        H_a  = flexibility(discretise(mesh, block(average)));
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> difference(H_a - H_r);
  EXPECT_GT(difference.eigenvalues()[0], 0.);

  // The mean displacement under a traction spread evenly is that of the frame without any coupling.
  auto uncoupled_specification         = block(average);
  uncoupled_specification.interfaces   = {};
  const auto                 uncoupled = discretise(mesh, uncoupled_specification);
  const auto                 quadratic = fem::quadratic_mesh(mesh);
  const auto                 patch     = fem::surface_patch(mesh, quadratic, {"z1"}, "test", "");
  fem::MultipointConstraints constraints(quadratic.n_nodes());
  for (const int node : fem::surface_patch(mesh, quadratic, {"z0"}, "test", "").nodes)
    for (int d = 0; d < 3; ++d)
      constraints.held[3 * node + d] = 1;
  const fem::AffineConstraints affine(constraints);
  Eigen::VectorXd              load = Eigen::VectorXd::Zero(affine.n_displacements());
  for (std::size_t i = 0; i < patch.nodes.size(); ++i)
    load[3 * patch.nodes[i] + 2] = patch.weight[i] / patch.area;
  const Eigen::VectorXd f = affine.gather(load);
  EXPECT_NEAR(H_a(2, 2), f.dot(statics(uncoupled, f)), 1e-9 * H_a(2, 2));
}

TEST(AverageCoupling, MeetsRigidCouplingOnAStiffSurface)
{
  // A stiff surface: the block is short against its width in the sense of Saint-Venant only far from the foot, so the
  // softest mode (sway of a slender bar) is compared, where the section stays plane.  Their difference falls with the
  // slenderness.
  const auto difference = [](double length)
  {
    const fem::Mesh mesh = box_mesh({2, 2, static_cast<int>(4 * length)}, {0.5, 0.5, length});
    const double    r    = flexibility(discretise(mesh, block(rigid)))(0, 0),
                 a       = flexibility(discretise(mesh, block(average)))(0, 0);
    return (a - r) / a;
  };
  const double short_bar = difference(1.), long_bar = difference(4.);
  EXPECT_GT(long_bar, 0.);
  EXPECT_LT(long_bar, 2e-3);
  EXPECT_LT(long_bar, 0.2 * short_bar);
}

TEST(Interfaces, StandLastInOrderWithSixCoordinatesEach)
{
  auto specification       = free_steel();
  specification.interfaces = {interface("left", {"x0"}, average), interface("right", {"x1"}, rigid)};
  const auto frame         = discretise(block_mesh(5), specification);
  const int  n             = static_cast<int>(frame.C.rows());
  for (int i = 0; i < 6; ++i)
  {
    EXPECT_EQ(frame.interfaces[0].coordinate[i], n - 12 + i);
    EXPECT_EQ(frame.interfaces[1].coordinate[i], n - 6 + i);
  }
  EXPECT_EQ(frame.translations(n - 6, 0), 1.);
  EXPECT_EQ(frame.translations(n - 3, 0), 0.);
}

TEST(Interfaces, ThatShareNodesAreRefusedNamingBothAndThePlace)
{
  auto specification                = block(rigid);
  specification.interfaces          = {interface("top", {"z1"}, rigid), interface("side", {"x0"}, average)};
  specification.interfaces[1].place = "press.toml:40: frame.interface.side";
  specification.supports            = {};
  const std::string message         = refusal([&] { discretise(block_mesh(), specification); });
  EXPECT_NE(message.find("press.toml:40: frame.interface.side: interface \"side\""), std::string::npos) << message;
  EXPECT_NE(message.find("interface \"top\""), std::string::npos) << message;
  EXPECT_NE(message.find(", 1.5) m with"), std::string::npos) << message;
}

TEST(Interfaces, ThatShareNodesWithAClampedSupportAreRefused)
{
  auto specification       = block(rigid);
  specification.interfaces = {interface("side", {"x0"}, rigid)};
  expect_refusal([&] { discretise(block_mesh(), specification); }, "clamped support \"foot\"");
}

TEST(Interfaces, OnUnknownSurfacesAreRefusedWithTheNearestNames)
{
  auto specification                = free_steel();
  specification.interfaces          = {interface("top", {"z2"}, rigid)};
  specification.interfaces[0].place = "press.toml:40";
  const std::string message         = refusal([&] { discretise(block_mesh(), specification); });
  EXPECT_NE(message.find("press.toml:40: interface \"top\" names the surface \"z2\""), std::string::npos) << message;
  EXPECT_NE(message.find("\"z0\""), std::string::npos) << message;
}

TEST(Interfaces, OnNoSurfaceOrAnEmptyOneAreRefused)
{
  auto specification       = free_steel();
  specification.interfaces = {interface("top", {}, rigid)};
  expect_refusal([&] { discretise(block_mesh(), specification); }, "names no surface");
  fem::Mesh mesh           = block_mesh();
  mesh.surfaces["nothing"] = {};
  specification.interfaces = {interface("top", {"nothing"}, rigid)};
  expect_refusal([&] { discretise(mesh, specification); }, "has no triangle");
}

TEST(Interfaces, OnASurfaceAsNarrowAsALineAreRefused)
{
  // Triangles of 1 m x 1e-7 m: their points lie on a line for all practical purposes.
  fem::Mesh mesh           = box_mesh({1, 1, 1}, {1., 1e-7, 1e-7});
  auto      specification  = free_steel();
  specification.interfaces = {interface("edge", {"y0"}, average)};
  expect_refusal([&] { discretise(mesh, specification); }, "are on one line");
}

} // namespace
} // namespace gestell::test
