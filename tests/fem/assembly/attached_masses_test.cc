#include "fem/recovery/discretisation.h"
#include "tests/support/box_mesh.h"
#include "tests/support/lowest_modes.h"
#include "tests/support/statics.h"
#include "tests/support/test.h"

namespace gestell::test
{
namespace
{

using fem::discretise;
using fem::InterfaceCoupling;

constexpr double beam_length = 2., width = 0.2, height = 0.25, area = width * height;

fem::Mesh bar_mesh()
{
  return box_mesh({{8, 2, 2}}, {{beam_length, width, height}});
}

/// A bar along x, clamped at x = 0, with the node "tip" on its other end.
fem::FrameSpecification cantilever()
{
  auto specification        = free_steel();
  specification.material.nu = 0.;
  specification.supports    = {clamped("wall", {"x0"})};
  specification.interfaces  = {interface("tip", {"x1"}, InterfaceCoupling::rigid)};
  return specification;
}

/// On the interface "tip", unless it has surfaces.
fem::AttachedMass motor(double mass, const fem::Vector3 &centre,
                        const Eigen::Vector3d &moments = Eigen::Vector3d::Zero())
{
  fem::AttachedMass result;
  result.name      = "motor";
  result.mass      = mass;
  result.centre    = centre;
  result.interface = "tip";
  result.inertia   = moments.asDiagonal();
  return result;
}

TEST(AttachedMass, OnTheTipOfACantileverSwaysByRayleighsRule)
{
  // f = 1/(2 pi) sqrt(1 / (w (m + 33/140 m_bar))), w the deflection of a unit force after Timoshenko; lengthwise
  // m_bar/3. Of twenty times the bar's mass the rule is right within 1e-4; the mesh, two cells thick, is too stiff by
  // 0.5 %.
  const double bar = 7850. * beam_length * area, mass = 20. * bar;
  auto         specification = cantilever();
  specification.masses       = {motor(mass, {beam_length, 0.5 * width, 0.5 * height})};
  const auto sway            = [&](double depth, double other)
  {
    const double I = other * std::pow(depth, 3) / 12., shear = 5. / 6. * 105e9 * area;
    const double w = std::pow(beam_length, 3) / (3. * 210e9 * I) + beam_length / shear;
    return 1. / (2. * M_PI * std::sqrt((mass + 33. / 140. * bar) * w));
  };
  const Eigen::VectorXd f = lowest_modes(discretise(bar_mesh(), specification), 3).frequency_hz;
  EXPECT_NEAR(f[0], sway(width, height), 5e-3 * f[0]);
  EXPECT_NEAR(f[1], sway(height, width), 5e-3 * f[1]);
  const double lengthwise = std::sqrt(210e9 * area / beam_length / (mass + bar / 3.)) / (2. * M_PI);
  EXPECT_LT((f.array() / lengthwise - 1.).abs().minCoeff(), 5e-3);
}

TEST(AttachedMass, BesideItsNodeHasTheInertiaOfARigidBodyAboutIt)
{
  // M_node written out by the moments and products of inertia about the node and the velocity of the centre,
  // v = u0' + theta' x c.
  auto                  specification = cantilever();
  const Eigen::MatrixXd without       = discretise(bar_mesh(), specification).M;
  const Eigen::Vector3d c(0.3, -0.2, 0.4), J(4., 9., 7.);
  const double          m = 250.;
  specification.masses    = {motor(m, {beam_length + c[0], 0.5 * width + c[1], 0.5 * height + c[2]}, J)};
  const auto      frame   = discretise(bar_mesh(), specification);
  Eigen::MatrixXd M       = Eigen::MatrixXd::Zero(6, 6);
  M.diagonal() << m, m, m, J[0] + m * (c[1] * c[1] + c[2] * c[2]), J[1] + m * (c[0] * c[0] + c[2] * c[2]),
      J[2] + m * (c[0] * c[0] + c[1] * c[1]);
  const auto set = [&](int i, int j, double value) { M(i, j) = M(j, i) = value; };
  set(3, 4, -m * c[0] * c[1]), set(3, 5, -m * c[0] * c[2]), set(4, 5, -m * c[1] * c[2]);
  set(0, 4, m * c[2]), set(0, 5, -m * c[1]), set(1, 3, -m * c[2]), set(1, 5, m * c[0]), set(2, 3, m * c[1]),
      set(2, 4, -m * c[0]);
  const std::vector<int> tip(frame.interfaces[0].coordinate.begin(), frame.interfaces[0].coordinate.end());
  const Eigen::MatrixXd  added = Eigen::MatrixXd(frame.M) - without;
  EXPECT_LT((added(tip, tip) - M).norm(), 1e-12 * M.norm());
  EXPECT_NEAR(added.norm(), M.norm(), 1e-12 * M.norm()) << "and nothing elsewhere";
}

TEST(AttachedMass, JoinsMassCentreAndInertiaOfTheFrame)
{
  // A bar and a ball of J = 2/5 m r^2, by Huygens and Steiner; once on a node elsewhere and once on surfaces.
  const double          bar = 7850. * beam_length * area, ball = 500., r = 0.3;
  const Eigen::Vector3d of_bar(0.5 * beam_length, 0.5 * width, 0.5 * height), of_ball(1.2, 0.6, -0.4);
  const Eigen::Vector3d centre = (bar * of_bar + ball * of_ball) / (bar + ball);
  Eigen::Matrix3d       exact  = 0.4 * ball * r * r * Eigen::Matrix3d::Identity();
  exact.diagonal() += bar / 12. *
                      Eigen::Vector3d(width * width + height * height, beam_length * beam_length + height * height,
                                      beam_length * beam_length + width * width);
  for (const auto &[m, at] : {std::pair(bar, of_bar), std::pair(ball, of_ball)})
    exact +=
        m * ((at - centre).squaredNorm() * Eigen::Matrix3d::Identity() - (at - centre) * (at - centre).transpose());

  auto on_node      = cantilever();
  on_node.supports  = {};
  on_node.masses    = {motor(ball, {1.2, 0.6, -0.4}, Eigen::Vector3d::Constant(0.4 * ball * r * r))};
  auto on_faces     = on_node;
  auto average_face = on_node;
  on_faces.masses[0].interface.clear();
  on_faces.masses[0].surfaces     = {"y1"};
  on_faces.interfaces[0].surfaces = {"y0"};
  average_face.masses             = on_faces.masses;
  average_face.interfaces         = on_faces.interfaces;
  average_face.masses[0].coupling = InterfaceCoupling::average;
  for (const auto &specification : {on_node, on_faces, average_face})
  {
    const auto frame = discretise(bar_mesh(), specification);
    EXPECT_NEAR(frame.mass, bar + ball, 1e-10 * frame.mass);
    EXPECT_LT((frame.facts.whole.centre - centre).norm(), 1e-12);
    EXPECT_LT((frame.facts.whole.inertia - exact).norm(), 1e-11 * exact.norm());
    // the matrices say the same
    Eigen::MatrixXd rigid = Eigen::MatrixXd::Zero(6, 6);
    rigid.topLeftCorner<3, 3>().diagonal().setConstant(bar + ball);
    rigid.bottomRightCorner<3, 3>() = exact;
    EXPECT_LT((frame.rigid_motions.transpose() * (frame.M * frame.rigid_motions) - rigid).norm(), 1e-10 * rigid.norm());
    EXPECT_LT((frame.acceleration_load - frame.M * frame.translations).norm(), 1e-11 * frame.acceleration_load.norm());
    EXPECT_EQ(frame.interfaces.size(), 1u);
    EXPECT_EQ(frame.interfaces[0].coordinate[5], frame.C.rows() - 1) << "interfaces stay last";
    ASSERT_EQ(frame.facts.parts.size(), 2u);
    EXPECT_EQ(frame.facts.parts[1].name, "motor");
    EXPECT_NEAR(frame.facts.parts[0].mass, bar, 1e-10 * bar);
  }
}

/// A centre in millimetres without its unit is told.
TEST(AttachedMass, FartherFromItsFacesThanTheFrameIsLargeIsReported)
{
  auto near               = free_steel();
  near.masses             = {motor(2., {1., 0.5, 0.4})};
  near.masses[0].surfaces = {"y1"};
  near.masses[0].interface.clear();
  auto far             = near;
  far.masses[0].centre = fem::Vector3{100., 50., 40.};
  EXPECT_TRUE(discretise(bar_mesh(), near).notes.empty());
  const auto notes = discretise(bar_mesh(), far).notes;
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("\"motor\" is at (100, 50, 40) m, 1"), std::string::npos) << notes[0];
}

TEST(AttachedMass, HangsOnTheFrameUnderGravity)
{
  auto       specification    = cantilever();
  const auto plain            = discretise(bar_mesh(), specification);
  specification.masses        = {motor(1000., {beam_length + 0.5, 0.5 * width, 0.5 * height})};
  const auto            frame = discretise(bar_mesh(), specification);
  const auto           &tip   = frame.interfaces[0].coordinate;
  const Eigen::VectorXd q     = statics(frame, -9.81 * frame.acceleration_load.col(2));
  Eigen::VectorXd       load  = -9.81 * plain.acceleration_load.col(2);
  load[tip[fem::uz]] -= 9810.;
  load[tip[fem::ry]] += 9810. * 0.5; // M = c x F, c = (0.5, 0, 0), F = (0, 0, -9810)
  EXPECT_LT((q - statics(plain, load)).norm(), 1e-9 * q.norm());
}

TEST(AttachedMass, OfImpossibleNumbersOrPlacesIsRefused)
{
  const auto refuse = [](const fem::AttachedMass &mass)
  {
    auto specification            = cantilever();
    specification.masses          = {mass};
    specification.masses[0].place = "press.toml:20: frame.mass.motor";
    return refusal([&] { discretise(box_mesh({{2, 1, 1}}, {{beam_length, width, height}}), specification); });
  };
  EXPECT_NE(refuse(motor(-3., {})).find("press.toml:20: frame.mass.motor: mass \"motor\" has -3"), std::string::npos);
  EXPECT_NE(refuse(motor(3., {}, {1., 1., 2.5})).find("at most the sum of the two others"), std::string::npos);
  auto other      = motor(3., {});
  other.interface = "tap";
  EXPECT_NE(refuse(other).find("no interface \"tap\"; the nearest names are \"tip\""), std::string::npos);
  other.interface = "";
  other.surfaces  = {"x1"};
  EXPECT_NE(refuse(other).find("interface \"tip\" shares the point"), std::string::npos) << refuse(other);
  EXPECT_NE(refuse(other).find("with mass \"motor\""), std::string::npos) << refuse(other);
}

} // namespace
} // namespace gestell::test
