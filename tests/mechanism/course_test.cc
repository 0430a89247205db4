// Courses that obey orders, and elements that are switched off and on.

#include "tests/support/element_probe.h"

#include "mechanism/elements/coulomb_friction.h"
#include "mechanism/elements/spring_damper.h"
#include "mechanism/functions/commanded_profile.h"
#include "mechanism/joints/motion_law.h"
#include "mechanism/switched_element.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using mechanism::CommandedProfile;
using mechanism::Profile;
using mechanism::SwitchCommand;
using mechanism::SwitchedElement;

constexpr double rounding = 1e-12;

/// A course with its history, gone through in time.
struct Followed
{
  Followed(const CommandedProfile &c, double t) : course(c), history(c.n_history()) { course.start(t, history.data()); }
  double value(double t) const { return course.at(t, true, history.data()).value; }
  double free(double t) const { return course.at(t, false, history.data()).value; }
  /// Takes the corner that lies ahead and tells when it is.
  double pass_corner()
  {
    double g = 0.;
    EXPECT_EQ(course.n_guards(history.data()), 1);
    course.guard_values(0., history.data(), &g);
    course.transition(0, -g, history.data());
    return -g;
  }
  CommandedProfile    course;
  std::vector<double> history;
};

// From 3 to 1 within a rate of 4 and a rate of rate of 16: a/j = 0.25 s of each curve, |D|/a - a/j = 0.25 s between.
TEST(CommandedProfile, IsSetByARampOfItsLimits)
{
  Followed motion(CommandedProfile(3.), 0.);
  ASSERT_TRUE(motion.course.command({"set", 1., 4., 16.}, 2., motion.history.data()));
  EXPECT_EQ(motion.value(2.), 3.);
  EXPECT_NEAR(motion.free(2.25), 3. - 0.5, rounding); // j t^2/2
  EXPECT_NEAR(motion.free(2.5), 1.5, rounding);
  EXPECT_NEAR(motion.free(2.75), 1., rounding);
  EXPECT_NEAR(motion.pass_corner(), 2.25, rounding);
  EXPECT_NEAR(motion.pass_corner(), 2.5, rounding);
  EXPECT_NEAR(motion.value(2.6), 1. + 8. * 0.15 * 0.15, rounding);
  EXPECT_NEAR(motion.pass_corner(), 2.75, rounding);
  EXPECT_EQ(motion.value(9.), 1.);
  EXPECT_EQ(motion.course.n_guards(motion.history.data()), 0);
}

TEST(CommandedProfile, HoldsAndBrakesFromWhereItIs)
{
  Followed motion(CommandedProfile(Profile("ramp", 0., {{1., 10., 2.}})), 0.);
  EXPECT_NEAR(motion.pass_corner(), 1., rounding);
  motion.course.command({"hold"}, 3., motion.history.data());
  EXPECT_NEAR(motion.value(3.), 4., rounding);
  EXPECT_NEAR(motion.value(99.), 4., rounding);
  motion.course.command({"brake", 7., 8.}, 5., motion.history.data()); // to zero, whatever level it is given
  EXPECT_NEAR(motion.value(5.25), 2., rounding);
  EXPECT_NEAR(motion.pass_corner(), 5.5, rounding);
  EXPECT_TRUE(motion.course.is_zero(motion.history.data()));
}

TEST(CommandedProfile, WaitsForItsStart)
{
  Followed motion(CommandedProfile(Profile("ramp", 2., {{1., 10., 2.}})).waiting(2.), 0.);
  EXPECT_EQ(motion.value(50.), 2.);
  EXPECT_EQ(motion.course.n_guards(motion.history.data()), 0);
  motion.course.command({"start"}, 50., motion.history.data());
  EXPECT_NEAR(motion.pass_corner(), 51., rounding);
  EXPECT_NEAR(motion.value(52.), 4., rounding);
}

TEST(CommandedProfile, FollowsAFormulaOfTheTime)
{
  using mechanism::Formula;
  const Formula t = Formula::variable(0);
  Followed      motion(CommandedProfile(mechanism::PositionFunction(abs(t + -1.))), 0.);
  EXPECT_EQ(motion.value(0.25), 0.75);
  EXPECT_NEAR(motion.pass_corner(), 1., rounding);
  EXPECT_EQ(motion.value(3.), 2.);
  EXPECT_FALSE(motion.course.command({"off"}, 3., motion.history.data()));
}

// The path is the integral of the speed and does not jump at an order.
TEST(ProfileMotion, KeepsItsPathAtOrders)
{
  const mechanism::ProfileMotion law(CommandedProfile(3.));
  std::vector<double>            history(law.n_history());
  law.start(1., history.data());
  EXPECT_NEAR(law.at(2., history.data()).value, 3., rounding);
  ASSERT_TRUE(law.command({"brake", 0., 6.}, 2., history.data()));
  EXPECT_NEAR(law.at(2., history.data()).value, 3., rounding);
  EXPECT_NEAR(law.at(2.25, history.data()).value, 3. + 0.75 - 0.5 * 6. * 0.0625, rounding);
  EXPECT_NEAR(law.at(2.25, history.data()).acceleration, -6., rounding);
  law.transition(0, 2.5, history.data());
  EXPECT_NEAR(law.at(7., history.data()).value, 3.75, rounding);   // v^2/(2 a)
  EXPECT_THROW(law.check_order({"brake"}), std::invalid_argument); // no finite force stops a mass at once
}

// --- switched elements

std::shared_ptr<mechanism::SpringDamper> spring()
{
  return std::make_shared<mechanism::SpringDamper>(mechanism::SpringDamper::Parameters{200., 3., 0., 0.});
}

TEST(SwitchedElement, ActsOnlyWhileItIsOn)
{
  const auto            law = spring();
  const SwitchedElement element(law, SwitchedElement::Begin::on);
  const Probe           probe   = probe1(0.1, 2.);
  Eigen::VectorXd       history = started(element, probe);
  double                p, dp;
  element.tangent(probe.motion(), history.data(), {1., 10., 0.}, &p, &dp);
  EXPECT_EQ(p, -26.);
  EXPECT_EQ(dp, -230.);
  EXPECT_EQ(element.stored_energy(probe.motion(), history.data()), 1.);

  ASSERT_TRUE(element.command({"off"}, probe.motion(), history.data()));
  element.tangent(probe.motion(), history.data(), {1., 10., 0.}, &p, &dp);
  EXPECT_EQ(p, 0.);
  EXPECT_EQ(dp, 0.);
  EXPECT_EQ(force(element, probe, history.data())[0], 0.);
  EXPECT_EQ(element.stored_energy(probe.motion(), history.data()), 0.);
  EXPECT_EQ(element.quantity(0, probe.motion(), history.data()), 0.);
  EXPECT_EQ(element.quantity(2, probe.motion(), history.data()), 2.); // it still knows how it moves
}

// A spring that is tight when it is put in brings 1 J along, which nothing in the machine had.
TEST(SwitchedElement, BeginsWithAnEmptyStore)
{
  const SwitchedElement element(spring(), SwitchedElement::Begin::off);
  const Probe           tight = probe1(0.1, 0.), loose = probe1(0., 0.);
  Eigen::VectorXd       history = started(element, tight);
  EXPECT_EQ(force(element, tight, history.data())[0], 0.);
  element.command({"on"}, tight.motion(), history.data());
  EXPECT_EQ(force(element, tight, history.data())[0], -20.);
  EXPECT_EQ(element.stored_energy(tight.motion(), history.data()), 0.);
  EXPECT_EQ(element.stored_energy(loose.motion(), history.data()), -1.);
  element.command({"off"}, loose.motion(), history.data());
  EXPECT_EQ(element.stored_energy(loose.motion(), history.data()), -1.); // nothing is dissipated then
  double K, D;
  engaged(element, tight.u.data(), &K, &D);
  EXPECT_EQ(K, 0.); // modes are those of the machine as it begins
}

TEST(SwitchedElement, HoldsNothingWhileItIsOff)
{
  mechanism::CoulombFriction::Parameters brake;
  brake.kinetic_force = brake.static_force = 10.;
  const SwitchedElement element(std::make_shared<mechanism::CoulombFriction>(brake), SwitchedElement::Begin::off);
  const Probe           rest    = probe1(0., 0.);
  Eigen::VectorXd       history = started(element, rest);
  double                rate;
  EXPECT_FALSE(element.holds(history.data(), rate));
  EXPECT_EQ(element.n_guards(history.data()), 0);
  element.command({"on"}, rest.motion(), history.data());
  EXPECT_TRUE(element.holds(history.data(), rate));
  EXPECT_EQ(element.n_guards(history.data()), 2);
  ASSERT_TRUE(element.command({"set", 0.}, rest.motion(), history.data())); // its own order: released
  EXPECT_FALSE(element.holds(history.data(), rate));
  EXPECT_THROW(element.check_order({"set", 1.5}), std::invalid_argument);
  const std::vector<std::string> orders = {"on", "off", "start", "hold", "set", "brake"};
  EXPECT_EQ(element.command_names(), orders);
}

} // namespace
} // namespace gestell::tests
