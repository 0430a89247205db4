// Journal, contact and friction in joints: forces by hand, balance of forces between two bodies.

#include "mechanism/elements/coulomb_friction.h"
#include "mechanism/elements/journal_bearing.h"
#include "mechanism/elements/lugre_friction.h"
#include "mechanism/elements/point_contact.h"
#include "mechanism/joints/friction_in_joint.h"
#include "mechanism/joints/joint_friction.h"
#include "mechanism/transmitted_element.h"
#include "tests/support/element_probe.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace mechanism;

const SlidingFriction            dry{0.1, 1e-3};
const JournalBearing::Parameters dry_bearing{5e-4, 0.03, 2e8, 0., 1., dry};

TEST(Journal, IsPushedBackAlongItsEccentricityAndTurnedAgainstItsSliding)
{
  const JournalBearing  journal(dry_bearing);
  const double          history = 0.;
  const Eigen::Vector2d n(0.6, 0.8), t(-0.8, 0.6);
  for (const double speed : {-20., 20.}) // rad/s: 0.6 m/s, far above v0
  {
    const Probe           probe{0., Eigen::Vector3d(7e-4 * n[0], 7e-4 * n[1], 2.), Eigen::Vector3d(0., 0., speed),
                      Eigen::Vector3d::Zero()};
    const Eigen::VectorXd p = force(journal, probe, &history);
    const double          N = 2e8 * 2e-4, T = speed > 0. ? -0.1 * N : 0.1 * N;
    EXPECT_LT((p.head(2) + N * n - T * t).norm(), 1e-9 * N);
    EXPECT_NEAR(p[2], 0.03 * T, 1e-9 * std::abs(T));
    EXPECT_NEAR(journal.quantity(1, probe.motion(), &history), N, 1e-9 * N);
    EXPECT_NEAR(journal.quantity(2, probe.motion(), &history), T, 1e-9 * N);
    EXPECT_NEAR(journal.quantity(4, probe.motion(), &history), std::atan2(0.8, 0.6), 1e-12);
    EXPECT_NEAR(journal.penetration(probe.motion()), 2e-4, 1e-15);
  }
}

// A journal that rolls along the wall does not slide: its centre goes round by e w_c, its surface by R w the other way.
TEST(Journal, DoesNotRubWhereItRolls)
{
  const JournalBearing journal(dry_bearing);
  const double         history = 0., e = 6e-4, w_c = 30.;
  const Probe          probe{0., Eigen::Vector3d(e, 0., 0.), Eigen::Vector3d(0., e * w_c, -e * w_c / 0.03),
                    Eigen::Vector3d::Zero()};
  EXPECT_NEAR(journal.quantity(2, probe.motion(), &history), 0., 1e-9);
  EXPECT_NEAR(journal.quantity(5, probe.motion(), &history), 0., 1e-15);
}

TEST(Journal, IsFreeAtItsCentre)
{
  const JournalBearing  journal(dry_bearing);
  const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
  for (const double history : {0., 1.})
    EXPECT_EQ(force(journal, {0., zero, Eigen::Vector3d(0.1, 0., 5.), zero}, &history, true).norm(), 0.);
}

TEST(Contact, HoldsAgainstTheSlidingByItsCoefficient)
{
  const PointContact    contact({{0., 1e6, 0., Clearance::Stops::below}, dry});
  const double          history = 0.;
  const Eigen::VectorXd p       = force(
            contact, {0., Eigen::Vector3d(-1e-3, 5., 5.), Eigen::Vector3d(0., 3., -4.), Eigen::Vector3d::Zero()}, &history);
  EXPECT_NEAR(p[0], 1e3, 1e-9);
  EXPECT_NEAR(p[1], -60., 1e-9);
  EXPECT_NEAR(p[2], 80., 1e-9);
}

// --- between two bodies that move

/// Two bodies in the plane z = 0: measures x, y, angle each, both turned.
struct TwoBodies
{
  const Vector3d  c_1{0.3, -0.2, 0.}, c_2{-0.1, 0.5, 0.}, at{0.2, 0.1, 0.};
  const Placement first{at, c_1, plane, Vector3d::UnitZ()}, second{at, c_2, plane, Vector3d::UnitZ()};

  static const std::vector<Placement::LinearMeasure> plane;

  TransmittedElement journal(const JournalBearing::Parameters &parameters) const
  {
    RelativeMeasure y[2], turn;
    for (int i = 0; i < 2; ++i)
    {
      y[i].a       = Vector3d::Unit(i);
      y[i].carrier = RelativeMeasure::Carrier::first;
    }
    turn.form   = RelativeMeasure::Form::ratio;
    turn.ratios = {0., 0., -1., 0., 0., 1.};
    return {first, second, {y[0], y[1], turn}, std::make_shared<JournalBearing>(parameters)};
  }

  /// The places lie d apart.
  Probe apart(const Vector3d &d, const Eigen::VectorXd &v) const
  {
    Eigen::VectorXd u(6);
    u << 0.02, 0.01, 0.4, 0., 0., -1.1;
    const Vector3d x_1 = first.position(u.data()), x_2 = second.position(u.data() + 3);
    u[3] += d[0] + x_1[0] - x_2[0];
    u[4] += d[1] + x_1[1] - x_2[1];
    return {0., u, v, Eigen::VectorXd::Zero(6)};
  }
};
const std::vector<Placement::LinearMeasure> TwoBodies::plane = {{Vector3d::UnitX(), Vector3d::Zero()},
                                                                {Vector3d::UnitY(), Vector3d::Zero()}};

// Forces between the bodies do no work on a motion of both together: action equals reaction, moments included.
TEST(TransmittedJournal, ForcesAndMomentsOnBothBodiesBalance)
{
  const TwoBodies          bodies;
  const TransmittedElement element = bodies.journal(dry_bearing);
  Eigen::VectorXd          v(6);
  v << 0.1, -0.2, 3., 0.05, 0.1, -7.;
  const Probe           probe   = bodies.apart({5e-4, 6e-4, 0.}, v);
  const double          history = 0.;
  const Eigen::VectorXd p       = force(element, probe, &history);
  ASSERT_GT(p.norm(), 1e4);
  EXPECT_NEAR(p[0] + p[3], 0., 1e-11 * p.norm());
  EXPECT_NEAR(p[1] + p[4], 0., 1e-11 * p.norm());
  const Vector3d x_1 = bodies.c_1 + Vector3d(probe.u[0], probe.u[1], 0.),
                 x_2 = bodies.c_2 + Vector3d(probe.u[3], probe.u[4], 0.);
  EXPECT_NEAR(p[2] + x_1[0] * p[1] - x_1[1] * p[0] + p[5] + x_2[0] * p[4] - x_2[1] * p[3], 0., 1e-11 * p.norm());
}

// The wall and the journal in it turn together: nothing slides, however far the point is from the centre of mass.
TEST(TransmittedJournal, SeesNoMotionWhereBothTurnAsOneBody)
{
  const TwoBodies          bodies;
  const TransmittedElement element = bodies.journal(dry_bearing);
  Probe                    probe   = bodies.apart({5e-4, 6e-4, 0.}, Eigen::VectorXd::Zero(6));
  const Vector3d           x_1     = bodies.c_1 + Vector3d(probe.u[0], probe.u[1], 0.),
                 x_2               = bodies.c_2 + Vector3d(probe.u[3], probe.u[4], 0.);
  probe.v << -4. * x_1[1], 4. * x_1[0], 4., -4. * x_2[1], 4. * x_2[0], 4.;
  const double history = 0.;
  EXPECT_NEAR(element.quantity(5, probe.motion(), &history), 0., 1e-15);
  EXPECT_NEAR(element.quantity(2, probe.motion(), &history), 0., 1e-8);
}

// At rest the tangent with G held and the geometric stiffness are the whole derivative; by rates the tangent is exact.
TEST(TransmittedJournal, TangentAndGeometricStiffnessAreTheDerivative)
{
  const TwoBodies          bodies;
  const TransmittedElement element = bodies.journal(dry_bearing);
  const double             history = 0.;
  for (const double turning : {0., 5e-4}) // some 0.3 mm/s at the contact, below v0
  {
    Eigen::VectorXd v     = Eigen::VectorXd::Zero(6);
    v[5]                  = turning;
    const Probe     probe = bodies.apart({5e-4, 6e-4, 0.}, v);
    Eigen::VectorXd p(6);
    Eigen::MatrixXd of_u(6, 6), of_v(6, 6), K(6, 6);
    element.derivatives(probe.motion(), &history, p.data(), of_u.data(), of_v.data());
    geometric(element, probe.motion(), &history, K.data());
    for (int j = 0; j < 6; ++j)
      for (const bool rate : {false, true})
      {
        const double d    = rate ? 1e-6 : 1e-8;
        Probe        plus = probe, minus = probe;
        (rate ? plus.v : plus.u)[j] += d;
        (rate ? minus.v : minus.u)[j] -= d;
        const Eigen::VectorXd quotient = (force(element, plus, &history) - force(element, minus, &history)) / (2. * d);
        const Eigen::MatrixXd expected = rate ? of_v : Eigen::MatrixXd(of_u - K);
        if (!rate && turning != 0.)
          continue; // v^T s'' comes in, which the tangent leaves out
        EXPECT_LT((quotient - expected.col(j)).norm(), 1e-6 * expected.norm()) << j << (rate ? " rate" : "");
      }
  }
}

// --- friction in joints

TEST(JointFriction, IsTheCoefficientTimesTheForceOfTheJoint)
{
  const JointFriction<1> pin({dry, {0.02}, {2, 0}});
  const double           lambda[] = {300., -400.}, v = 30., u = 0.;
  LocalMotion            motion{0., &u, &v, &u, nullptr, false, lambda};
  double                 p, dp;
  pin.tangent(motion, nullptr, {0., 1., 0.}, &p, &dp);
  EXPECT_NEAR(p, -0.1 * 500. * 0.02, 1e-12); // 0.6 m/s: tanh = 1
  EXPECT_NEAR(dp, 0., 1e-9);
  motion.lambda = nullptr;
  pin.force(motion, nullptr, &p);
  EXPECT_EQ(p, 0.);
}

TEST(JointFriction, CountsTheTorqueOnAGuideByItsLength)
{
  const JointFriction<1> guide({dry, {}, {1, 1, 0.5}});
  const double           v = 2., u = 0.;
  double                 p;
  for (const auto &[F, M, N] : {std::array{100., 10., 100.}, std::array{100., -80., 320.}})
  {
    const double lambda[] = {F, M};
    guide.force({0., &u, &v, &u, nullptr, false, lambda}, nullptr, &p);
    EXPECT_NEAR(p, -0.1 * N, 1e-9);
    EXPECT_NEAR(N, std::abs(F / 2. + M / 0.5) + std::abs(F / 2. - M / 0.5), 1e-9); // what it means
  }
}

TEST(JointFriction, TangentEqualsCentralQuotients)
{
  const JointFriction<2> plane({{0.1, 1e-3, 0.3, 0.02, 2.}, {}, {1, 0}});
  const double           lambda = -300., u[] = {0., 0.}, v[] = {5e-4, -2e-3};
  double                 p[2], dp[4];
  plane.tangent({0., u, v, u, nullptr, false, &lambda}, nullptr, {0., 1., 0.}, p, dp);
  for (int j = 0; j < 2; ++j)
  {
    const double d      = 1e-8;
    double       plus[] = {v[0], v[1]}, minus[] = {v[0], v[1]}, p_plus[2], p_minus[2];
    plus[j] += d, minus[j] -= d;
    plane.force({0., u, plus, u, nullptr, false, &lambda}, nullptr, p_plus);
    plane.force({0., u, minus, u, nullptr, false, &lambda}, nullptr, p_minus);
    for (int i = 0; i < 2; ++i)
      EXPECT_NEAR(dp[i + 2 * j], (p_plus[i] - p_minus[i]) / (2. * d), 1e-3); // of some 1e4 N s/m
  }
}

// A pin of radius r that turns is its surface that slides by r phi: the torque is r times the force, with the same
// bristles, for any of their laws.
TEST(JointFriction, OfAPinIsThatOfItsSurfaceAtItsRadius)
{
  const double                           r = 0.03, lambda[] = {300., -400.}, zero[] = {0., 0.};
  const CoulombFriction::Parameters      dry{0.2, 0.35, 0., 0.05, 2.};
  const LuGreFriction::Parameters        bristles{0.2, 0.3, 0.05, 2., 5e3, 40., 0.};
  const JointLoad                        load{2, 0};
  const FrictionInJoint<CoulombFriction> pin_dry(dry, load, r), slide_dry(dry, load, 0.);
  const FrictionInJoint<LuGreFriction>   pin(bristles, load, r), slide(bristles, load, 0.);
  for (const double v : {-0.4, 0.02, 0.7}) // of the surface [m/s]
  {
    const double history[] = {v < 0. ? -1. : 1., 0.}, turning[] = {v / r, 0.}, sliding[] = {v, 0.};
    double       torque, force;
    pin_dry.force({0., zero, turning, zero, nullptr, false, lambda}, history, &torque);
    slide_dry.force({0., zero, sliding, zero, nullptr, false, lambda}, history, &force);
    EXPECT_NEAR(torque, r * force, 1e-13) << v;
    EXPECT_NEAR(pin_dry.quantity(1, {0., zero, turning, zero, nullptr, false, lambda}, history), v, 1e-15);
    for (const double F : {-0.1, 0.15}) // of the bristles, per unit of the normal force
    {
      const double by_angle[] = {0., r * F}, by_way[] = {0., F};
      double       p_angle[2], p_way[2];
      pin.force({0., by_angle, turning, zero, nullptr, false, lambda}, history, p_angle);
      slide.force({0., by_way, sliding, zero, nullptr, false, lambda}, history, p_way);
      EXPECT_NEAR(p_angle[0], r * p_way[0], 1e-12) << v << ' ' << F;
      EXPECT_NEAR(p_angle[1], r * p_way[1], 1e-12) << v << ' ' << F << ": the bristles follow alike";
    }
  }
}

// --- what makes no sense

TEST(PlayParameters, AreChecked)
{
  auto bad      = dry_bearing;
  bad.clearance = 0.;
  EXPECT_THROW(JournalBearing{bad}, std::invalid_argument);
  bad                  = dry_bearing;
  bad.friction.kinetic = -0.1;
  EXPECT_THROW(JournalBearing{bad}, std::invalid_argument);
  bad                = dry_bearing;
  bad.friction.speed = 0.;
  EXPECT_THROW(JournalBearing{bad}, std::invalid_argument);
  bad                         = dry_bearing;
  bad.friction.stribeck_speed = 0.1; // and a static coefficient of zero
  EXPECT_THROW(JournalBearing{bad}, std::invalid_argument);
  EXPECT_THROW(PointContact({{0., -1., 0., Clearance::Stops::below}, dry}), std::invalid_argument);
  EXPECT_THROW(JointFriction<1>({dry, {-0.1}, {2, 0}}), std::invalid_argument);
}

} // namespace
} // namespace gestell::tests
