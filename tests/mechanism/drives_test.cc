// Profiles, and the elements that drive, pull and rub: single laws against closed forms.

#include "mechanism/elements/clearance.h"
#include "mechanism/elements/coulomb_friction.h"
#include "mechanism/elements/drawing_force.h"
#include "mechanism/elements/dynamic_motor.h"
#include "mechanism/elements/gas_force.h"
#include "mechanism/elements/lugre_friction.h"
#include "mechanism/elements/profile_force.h"
#include "mechanism/elements/regularised_friction.h"
#include "mechanism/elements/rope.h"
#include "mechanism/elements/speed_drive.h"
#include "mechanism/elements/wheel.h"
#include "mechanism/functions/profile.h"
#include "tests/support/prescribed_path.h"
#include "tests/support/refusal.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace mechanism;
constexpr double unlimited = Profile::unlimited;

double at(const Profile &profile, double t)
{
  return profile.value(profile.piece_at(t), t);
}

// --- profile

TEST(Profile, RampsWithLimitedRateAndRateOfRateTakeTheirShortestTime)
{
  // Up by 12 with 4/s and 8/s^2: D/a + a/j = 3.5 s.  Down by 1: too short for the rate, 2 sqrt(D/j) = 0.7071 s.
  const Profile profile("test", 3., {{1., 15., 4., 8.}, {6., 14., 4., 8.}});
  EXPECT_EQ(at(profile, 0.), 3.);
  EXPECT_EQ(at(profile, 1.), 3.);
  EXPECT_NEAR(at(profile, 1.25), 3. + 4. * 0.25 * 0.25, 1e-14);
  EXPECT_NEAR(at(profile, 2.75), 9., 1e-14); // halfway
  EXPECT_NEAR(at(profile, 4.25), 15. - 4. * 0.25 * 0.25, 1e-14);
  EXPECT_EQ(at(profile, 5.), 15.);
  const double half = std::sqrt(1. / 8.);
  EXPECT_NEAR(at(profile, 6. + half), 14.5, 1e-14);
  EXPECT_EQ(at(profile, 6. + 2.0001 * half), 14.);
  EXPECT_NEAR(profile.end(), 6. + 2. * half, 1e-15);

  const double d       = 1e-4;
  double       fastest = 0., sharpest = 0.;
  for (double t = 0.5; t < 7.5; t += 0.00731)
  {
    fastest  = std::max(fastest, std::abs(at(profile, t + d) - at(profile, t - d)) / (2. * d));
    sharpest = std::max(sharpest, std::abs(at(profile, t + d) - 2. * at(profile, t) + at(profile, t - d)) / (d * d));
  }
  EXPECT_NEAR(fastest, 4., 1e-9);
  EXPECT_NEAR(sharpest, 8., 1e-5);
}

TEST(Profile, WithoutLimitsIsALineOrAJump)
{
  const Profile profile("test", 0., {{1., 2., 4.}, {3., -1.}});
  EXPECT_NEAR(at(profile, 1.25), 1., 1e-15);
  EXPECT_EQ(at(profile, 1.5), 2.);
  EXPECT_EQ(at(profile, 2.999), 2.);
  EXPECT_EQ(at(profile, 3.), -1.);
  EXPECT_TRUE(Profile("test", 2., {{1., 2., 4.}}).is_constant()); // no way to go
  EXPECT_EQ(at(Profile(7.), 1e9), 7.);
}

TEST(Profile, RefusesRampsThatOverlapOrStandStill)
{
  expect_refusal(
      [] {
        Profile("drive", 0., {{1., 2., 4.}, {1.4, 3.}});
      },
      "ramp 2, begin [s] = 1.4, but it must "
      "be 1.5 s (end of the previous ramp)");
  expect_refusal([] { Profile("drive", 0., {{1., 2., 0.}}); }, "ramp 1, largest rate = 0");
  expect_refusal([] { Profile("drive", 0., {{1., 2., 1., -1.}}); }, "largest rate of rate = -1");
  expect_refusal([] { Profile("drive", 0., {{1., std::nan("")}}); }, "level");
}

TEST(ProfileForce, IsItsProfile)
{
  const Profile      profile("test", 1., {{1., 4., 3., 6.}});
  const ProfileForce element(profile);
  Probe              probe   = probe1(0., 2.);
  Eigen::VectorXd    history = started(element, probe);
  EXPECT_EQ(force(element, probe, history.data())[0], 1.);
  probe.t = 1.;
  EXPECT_EQ(past(element, 0, probe, history.data()), 0.);
  element.transition(0, probe.motion(true), history.data());
  EXPECT_GT(force(element, probe.moved(0.1), history.data(), true)[0], 1.);
  EXPECT_EQ(element.quantity(1, probe.motion(true), history.data()), 2.);
}

// --- drives

Probe probe2(double t, double speed, double state)
{
  return {t, Eigen::Vector2d(0., state), Eigen::Vector2d(speed, 0.), Eigen::Vector2d::Zero()};
}

TEST(SpeedDrive, IsProportionalWithinItsLimitsAndReportsWhenItMeetsThem)
{
  const SpeedDrive drive({10., 20., 100., Profile(30.)});
  EXPECT_EQ(drive.lag(), 0.5);
  const Eigen::VectorXd inside = started(drive, probe2(0., 25., 7.));
  EXPECT_EQ(force(drive, probe2(0., 25., 7.), inside.data())[0], 57.);
  EXPECT_EQ(force(drive, probe2(0., 25., 7.), inside.data())[1], 57.);
  EXPECT_LT(past(drive, 0, probe2(0., 20.8, 7.), inside.data()), 0.);
  EXPECT_GT(past(drive, 0, probe2(0., 20.6, 7.), inside.data()), 0.);
  EXPECT_GT(past(drive, 1, probe2(0., 40.8, 7.), inside.data()), 0.);
  EXPECT_EQ(force(drive, probe2(0., 10., 7.), inside.data())[0], 100.);
  EXPECT_EQ(force(drive, probe2(0., 10., 7.), inside.data(), true)[0], 207.); // smoothly on
  Eigen::VectorXd limit = inside;
  drive.transition(1, probe2(0., 40.7, 7.).motion(true), limit.data());
  EXPECT_EQ(force(drive, probe2(0., 40., 7.), limit.data(), true)[0], -100.);
  EXPECT_LT(past(drive, 0, probe2(0., 40.8, 7.), limit.data()), 0.);
  EXPECT_GT(past(drive, 0, probe2(0., 40.6, 7.), limit.data()), 0.);
}

TEST(SpeedDrive, WithoutAnIntegralLeavesItsStateAlone)
{
  const SpeedDrive drive({10., 0., unlimited, Profile(30.)});
  const auto       history = started(drive, probe2(0., 25., 0.));
  EXPECT_EQ(force(drive, probe2(0., 25., 0.), history.data())[1], 0.);
  EXPECT_EQ(drive.n_guards(history.data()), 0);
}

// A motor whose synchronous speed is negative is the mirror image of one whose speed is positive: motoring, generating
// and braking in both directions.
TEST(KlossMotor, RunsBackwardsAsItRunsForwards)
{
  const KlossMotor forwards({240., 0.15, 157., 49.}), backwards({240., 0.15, -157., 49.});
  const double     synchronous = 157. / 49.;
  for (const double share : {-1.5, -0.9, -0.2, 0., 0.3, 0.8, 0.99, 1.02, 1.7})
  {
    const Probe  there = probe1(0., share * synchronous), mirrored = probe1(0., -share * synchronous);
    const double M = force(forwards, there, nullptr)[0], M_mirrored = force(backwards, mirrored, nullptr)[0];
    EXPECT_EQ(M_mirrored, -M) << share;
    EXPECT_EQ(M > 0., share < 1.) << share; // towards the synchronous speed
    for (int i = 0; i < 3; ++i)             // torque, power, slip
      EXPECT_EQ(backwards.quantity(i, mirrored.motion(), nullptr),
                (i == 0 ? -1. : 1.) * forwards.quantity(i, there.motion(), nullptr));
  }
}

TEST(DynamicMotor, PassesItsStateOnAndFollowsKloss)
{
  const KlossMotor::Parameters data{240., 0.15, 157., 49.};
  const DynamicMotor           motor(data);
  const Eigen::VectorXd        p = force(motor, probe2(0., 3.1, 77.), nullptr);
  EXPECT_EQ(p[0], 77.);
  EXPECT_EQ(p[1], force(KlossMotor(data), probe1(0., 3.1), nullptr)[0]);
}

// --- rope

TEST(Rope, PullsAndNeverPushes)
{
  const Rope      rope({1e4, 50., 2e-3});
  Eigen::VectorXd history = started(rope, probe1(1e-3, 5.));
  EXPECT_EQ(force(rope, probe1(1e-3, 5.), history.data())[0], 0.);
  EXPECT_EQ(force(rope, probe1(3e-3, 0.), history.data())[0], -10.);
  EXPECT_EQ(force(rope, probe1(3e-3, -0.3), history.data())[0], 0.); // -15 N of the damper would push
  EXPECT_LT(past(rope, 0, probe1(1.9e-3, 5.), history.data()), 0.);
  EXPECT_GT(past(rope, 0, probe1(2.1e-3, 5.), history.data()), 0.);
  EXPECT_LT(past(rope, 0, probe1(3e-3, -0.3), history.data()), 0.);
  rope.transition(0, probe1(2e-3, 5.).motion(true), history.data());
  EXPECT_EQ(rope.guards(history.data())[0].kind, "slack");
  EXPECT_GT(past(rope, 0, probe1(3e-3, -0.21), history.data()), 0.);
  EXPECT_LT(past(rope, 0, probe1(3e-3, -0.19), history.data()), 0.);
  EXPECT_EQ(rope.stored_energy(probe1(1e-3, 0.).motion(), history.data()), 0.);
}

// --- wheel

TEST(Wheel, TouchesDownWhereItsTyreIsPressedAndPushes)
{
  const Wheel     wheel({1e5, 200.});
  Eigen::VectorXd history = started(wheel, probe1(1e-3, -1.));
  EXPECT_EQ(force(wheel, probe1(1e-3, -1.), history.data())[0], 0.);
  EXPECT_EQ(force(wheel, probe1(-1e-3, 0.), history.data())[0], 100.);
  EXPECT_EQ(force(wheel, probe1(-1e-3, 0.6), history.data())[0], 0.); // -20 N of the damper would pull
  EXPECT_LT(past(wheel, 0, probe1(1e-4, -1.), history.data()), 0.) << "above the ground";
  EXPECT_GT(past(wheel, 0, probe1(-1e-4, -1.), history.data()), 0.);
  EXPECT_LT(past(wheel, 0, probe1(-1e-3, 0.6), history.data()), 0.) << "it rises faster than the tyre";
  EXPECT_GT(past(wheel, 0, probe1(-1e-3, 0.4), history.data()), 0.);
  wheel.transition(0, probe1(0., -1.).motion(true), history.data());
  EXPECT_EQ(wheel.guards(history.data())[0].kind, "lift_off");
  EXPECT_GT(past(wheel, 0, probe1(-1e-3, 0.6), history.data()), 0.) << "before the tyre is unloaded";
  EXPECT_LT(past(wheel, 0, probe1(-1e-3, 0.4), history.data()), 0.);
}

// --- contact after Hertz

TEST(Hertz, StoresTheIntegralOfItsForce)
{
  const Clearance       ball({1e-4, 5e9, 0., Clearance::Stops::both, 1.5});
  const double          depth = 3e-4, c = 5e9;
  const Probe           probe   = probe1(-1e-4 - depth, 0.);
  const Eigen::VectorXd history = started(ball, probe);
  EXPECT_NEAR(force(ball, probe, history.data())[0], c * std::pow(depth, 1.5), 1e-9 * c * std::pow(depth, 1.5));
  EXPECT_NEAR(ball.stored_energy(probe.motion(), history.data()), c * std::pow(depth, 2.5) / 2.5, 1e-12);
  double K, D;
  ball.engaged(probe.u.data(), &K, &D);
  EXPECT_NEAR(K, 1.5 * c * std::sqrt(depth), 1e-6 * K);
  expect_refusal([] { Clearance({0., 1., 0., Clearance::Stops::above, 0.9}); }, "exponent = 0.9");
}

// --- friction

TEST(Stribeck, FallsFromTheStaticToTheKineticForce)
{
  const CoulombFriction one({4., 6., 0., 0.1, 1., 2.}), two({4., 6., 0., 0.1, 2., 2.});
  const auto            history = started(one, probe1(0., 0.3));
  for (const double v : {1e-12, 0.05, 0.3})
    for (const double s : {1., -1.})
    {
      EXPECT_NEAR(force(one, probe1(0., s * v), history.data())[0], -s * (4. + 2. * std::exp(-10. * v) + 2. * v), 1e-9);
      EXPECT_NEAR(force(two, probe1(0., s * v), history.data())[0], -s * (4. + 2. * std::exp(-100. * v * v) + 2. * v),
                  1e-9);
    }
  // Past the event the slip goes on along its tangent.
  EXPECT_NEAR(force(one, probe1(0., -0.01), history.data(), true)[0], -(4. + 2. * 1.1) + 0.02, 1e-12);
  const RegularisedFriction smooth({4., 1e-3, 6., 0.1, 1., 2.});
  EXPECT_NEAR(force(smooth, probe1(0., 0.05), nullptr)[0], -(4. + 2. * std::exp(-0.5) + 0.1), 1e-12);
}

TEST(Brake, HoldsWhatItsEngagementAllows)
{
  CoulombFriction::Parameters data{4., 6., 0.};
  data.engagement = Profile("brake", 0., {{1., 1., 2.}, {2., 0.}});
  const CoulombFriction brake(data);
  Probe                 probe   = probe1(0., 0.3);
  Eigen::VectorXd       history = started(brake, probe);
  ASSERT_EQ(brake.n_guards(history.data()), 1); // released: nothing but the clock
  EXPECT_EQ(force(brake, probe, history.data())[0], 0.);
  probe.t = 1.;
  brake.transition(0, probe.motion(true), history.data());
  probe.t = 1.25;
  EXPECT_NEAR(force(brake, probe, history.data(), true)[0], -2., 1e-15);
  EXPECT_NEAR(force(brake, probe, history.data(), false)[0], -2., 1e-15);
  brake.transition(0, probe1(0., 0.).motion(true), history.data());
  double rate;
  ASSERT_TRUE(brake.holds(history.data(), rate));
  const double p = -2.9, too_much = -3.1; // capacity 3
  EXPECT_LT(past(brake, 0, probe, history.data(), &p), 0.);
  EXPECT_GT(past(brake, 0, probe, history.data(), &too_much), 0.);
  brake.transition(2, probe.motion(true, &p), history.data());
  probe.t = 2.;
  brake.transition(2, probe.motion(true, &p), history.data());
  EXPECT_FALSE(brake.holds(history.data(), rate));
  EXPECT_EQ(brake.n_guards(history.data()), 0);
  data.engagement = Profile("brake", 0., {{1., 1.2, 2.}});
  expect_refusal([&] { CoulombFriction{data}; }, "engagement = 1.2, but it must be between 0 and 1");
}

TEST(LuGre, SlidesWithTheStribeckForceAndIsASpringAtRest)
{
  const LuGreFriction friction({4., 6., 0.1, 1., 1e5, 300., 2.});
  const double        v = 0.05, slide = 4. + 2. * std::exp(-0.5);
  for (const double s : {1., -1.})
  {
    const auto            history = started(friction, probe2(0., s * v, s * slide));
    const Eigen::VectorXd p       = force(friction, probe2(0., s * v, s * slide), history.data());
    EXPECT_NEAR(p[0], -s * (slide + 2. * v), 1e-12);
    EXPECT_NEAR(p[1], s * slide, 1e-12); // the lag stands still
  }
  const double    history = 1.;
  Eigen::Vector2d p;
  Eigen::Matrix2d du, dv;
  friction.derivatives(probe2(0., 0., 0.).motion(true), &history, p.data(), du.data(), dv.data());
  EXPECT_EQ(du(0, 1), -1.);
  EXPECT_EQ(dv(0, 0), -302.);
  EXPECT_NEAR(dv(1, 0), 1e5 * LuGreFriction::lag(), 1e-9);
}

// --- forming

TEST(DrawingForce, TellsThePathDrawnAtTheInstant)
{
  constexpr int      drawn = 2;
  const DrawingForce sheet({1e4, 1e8, 0., 3e-3}); // rises over 0.1 mm
  Eigen::VectorXd    history = started(sheet, probe1(-1e-3, 0.1));
  const auto reported = [&](double z) { return sheet.quantity(drawn, probe1(z, 0.1).motion(true), history.data()); };
  sheet.transition(0, probe1(0., 0.1).motion(true), history.data());
  EXPECT_EQ(reported(5e-5), 0.);
  sheet.transition(1, probe1(1e-4, 0.1).motion(true), history.data());
  EXPECT_NEAR(reported(6e-4), 5e-4, 1e-15) << "ahead of the last accepted motion";
  sheet.transition(0, probe1(7e-4, 0.).motion(true), history.data());
  EXPECT_NEAR(reported(2e-4), 6e-4, 1e-15) << "on the way back";
}

TEST(DrawingForce, ComesBackOnlyBeyondTheLargestPath)
{
  const DrawingForce sheet({1e4, 1e8, 0., 3e-3});
  Eigen::VectorXd    history = started(sheet, probe1(1e-3, 0.1)); // flows since 0.1 mm
  EXPECT_EQ(force(sheet, probe1(1e-3, 0.1), history.data())[0], -1e4);
  sheet.transition(0, probe1(2e-3, 0.).motion(true), history.data());
  EXPECT_NEAR(force(sheet, probe1(1.95e-3, -0.1), history.data(), true)[0], -5e3, 1e-6);
  EXPECT_EQ(force(sheet, probe1(1.5e-3, 0.1), history.data())[0], 0.);
  EXPECT_NEAR(past(sheet, 0, probe1(1.9e-3, -0.1), history.data()), 0., 1e-15);
  EXPECT_NEAR(past(sheet, 1, probe1(2e-3, 0.1), history.data()), 0., 1e-15);
  expect_refusal([] { DrawingForce({1e4, 1e8, 0., 1e-4}); }, "above the rise");
  expect_refusal([] { DrawingForce({0., 1e8}); }, "force");
}

// --- whole motions

TEST(Paths, OfRopeToolAndPistonIsFollowedByTheirGuards)
{
  for (const Drive &drive :
       std::vector<Drive>{{"rope",
                           std::make_shared<Rope>(Rope::Parameters{1e4, 50., 2e-3}),
                           [](double t) { return swinging(t, 1e-3, 0., 3e-3, 100.); },
                           0.2,
                           {"taut", "slack"}},
                          {"drawing",
                           std::make_shared<DrawingForce>(DrawingForce::Parameters{1e4, 1e8, 1e-3, 3e-3}),
                           [](double t) { return swinging(t, 5e-4, 4e-3, 4e-4, 20.); },
                           1.2,
                           {"tool_contact", "flow_begins", "tool_unload", "tool_release", "drawn_through"}},
                          {"compressor",
                           std::make_shared<GasForce>(
                               GasForce::Parameters{1e-2, 5e-5, 0., 1.3, 2e5, 1e5, true, GasForce::Valves{1e5, 6e5}}),
                           [](double t) { return swinging(t, 0.05, 0., 0.05, 100.); },
                           0.2,
                           {"suction_opens", "suction_closes", "delivery_opens", "delivery_closes"}}})
    expect_guards_to_tell_every_branch(drive);
}

} // namespace
} // namespace gestell::tests
