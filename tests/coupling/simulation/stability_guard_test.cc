// The guard before a run: modes of small machines laid over the unstable intervals of the methods.

#include "coupling/integration/stability/stability.h"
#include "coupling/simulation/checks/stability_guard.h"
#include "fem/values/two_pi.h"
#include "mechanism/elements/clearance.h"
#include "tests/support/linear_joint.h"
#include "tests/support/methods.h"
#include "tests/support/refusal.h"
#include "tests/support/test.h"

#include <Eigen/Eigenvalues>

namespace gestell::tests
{
namespace
{

using namespace coupling;

struct Slider
{
  double frequency, damping_ratio; // of its spring to the ground; 0: free
};

/// Sliders of 2 kg, each on its own spring; the first one with play to the ground if the contact has a stiffness.
Machine sliders(const std::vector<Slider> &all, double contact_stiffness = 0.)
{
  MachineModel model;
  const double m = 2.;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    const std::string name  = "mass" + std::to_string(i);
    const Measure     u     = slider(model, name, m);
    const double      omega = two_pi * all[i].frequency;
    if (omega > 0.)
      model.add_linear("spring" + std::to_string(i), u,
                       {m * omega * omega, 2. * all[i].damping_ratio * m * omega, 0., 0.}, "N");
    if (i == 0 && contact_stiffness > 0.)
    {
      mechanism::Clearance::Parameters play;
      play.gap       = 1e-3;
      play.stiffness = contact_stiffness;
      model.attach("stop", std::make_shared<mechanism::Clearance>(play), {u});
    }
  }
  return Machine(std::move(model));
}

std::string guard_refusal(const Machine &machine, const MethodOptions &options)
{
  return tests::refusal([&] { StabilityGuard(linear_spectrum(machine, at_rest(machine)), options).check(); });
}

bool says(const std::string &message, const std::string &part)
{
  return message.find(part) != std::string::npos;
}

TEST(StabilityGuard, RefusesBdf3OnALightlyDampedModeAndNamesEverything)
{
  const Machine machine = sliders({{3., 0.2}, {150., 0.01}, {0., 0.}});
  const auto    message = guard_refusal(machine, bdf(3, 1e-3)); // omega h = 0.942 in (0.3567, 1.863)
  EXPECT_TRUE(says(message, "unstable")) << message;
  EXPECT_TRUE(says(message, "mode 3 of the frame (150 Hz, damping ratio 0.01)")) << message; // the free one is mode 1
  EXPECT_TRUE(says(message, "omega h is 0.94248")) << message;
  EXPECT_TRUE(says(message, "0.3566944 < omega h < 1.863028")) << message;
  EXPECT_TRUE(says(message, "run.step = \"378 us\"")) << message; // 0.3566944/(2 pi 150) = 378.46 us
  EXPECT_TRUE(says(message, "run.order = 2")) << message;
  EXPECT_TRUE(says(message, "run.force_unstable")) << message;
  const double rho = spectral_radius(bdf(3, 1.), {0.01, two_pi * 0.15});
  EXPECT_TRUE(says(message, std::to_string(rho).substr(0, 6))) << message << rho;
}

TEST(StabilityGuard, TheStepItOffersWorks)
{
  const Machine machine = sliders({{40., 0.02}, {150., 0.01}, {700., 0.015}});
  for (const MethodOptions &o : {bdf(3, 1e-3), bdf(4, 1e-3), bdf(6, 2e-3), method("central-difference", 1e-3)})
  {
    const LinearSpectrum spectrum = linear_spectrum(machine, at_rest(machine));
    const double         step     = StabilityGuard(spectrum, o).largest_stable_step();
    ASSERT_GT(step, 0.) << method_name(o);
    ASSERT_LT(step, o.step);
    EXPECT_FALSE(guard_refusal(machine, o).empty());
    MethodOptions smaller = o;
    smaller.step          = step;
    EXPECT_EQ(guard_refusal(machine, smaller), "") << method_name(o);
    smaller.step = 1.02 * step; // three digits are kept
    EXPECT_NE(guard_refusal(machine, smaller), "") << method_name(o);
  }
}

TEST(StabilityGuard, WhatIsStableIsNotRefused)
{
  // Undamped, stiff and free modes: roots on the unit circle, which rounding moves both ways.
  const Machine machine = sliders({{0., 0.}, {1e-3, 0.}, {10., 0.}, {1e3, 0.}, {1e6, 0.}, {5., 2.}});
  for (const double step : {1e-7, 1e-4, 1e-3, 0.1, 10.})
  {
    for (const int order : {1, 2})
      EXPECT_EQ(guard_refusal(machine, bdf(order, step)), "");
    for (const char *kind : {"newmark", "wilson", "hht", "generalised-alpha", "exact"})
      for (const double rho : {0., 0.8, 1.})
      {
        const MethodOptions o = method(kind, step, 2, {{"rho_inf", rho}, {"alpha", -0.3 * (1. - rho)}});
        EXPECT_EQ(guard_refusal(machine, o), "") << method_name(o) << ' ' << step;
      }
  }
  EXPECT_EQ(guard_refusal(machine, method("central-difference", 3e-7)), ""); // omega h = 1.885
  EXPECT_EQ(guard_refusal(machine, controlled(bdf(5, 1e-3), 1e-4)), "");     // its order is limited step by step
}

TEST(StabilityGuard, EveryMethodThatFailsIsRefused)
{
  const Machine machine = sliders({{150., 0.005}});
  const auto    at      = [](double omega_h) { return omega_h / (two_pi * 150.); };
  for (const int order : {3, 4, 5, 6})
    EXPECT_TRUE(says(guard_refusal(machine, bdf(order, at(1.5))), "unstable")) << order;

  MethodOptions wilson = method("wilson", at(10.));
  EXPECT_EQ(guard_refusal(machine, wilson), "");
  wilson.set("theta", 1.3);
  EXPECT_TRUE(says(guard_refusal(machine, wilson), "Wilson")) << guard_refusal(machine, wilson);

  MethodOptions newmark = method("newmark", at(3.5), 2, {{"beta", 1. / 6.}});
  EXPECT_TRUE(says(guard_refusal(machine, newmark), "omega h > 3.46"));
  newmark.step = at(3.4);
  EXPECT_EQ(guard_refusal(machine, newmark), "");
  newmark.set("beta", 0.25);
  newmark.set("gamma", 0.45); // grows from omega h = 2 zeta / 0.05 = 0.2 on
  EXPECT_TRUE(says(guard_refusal(machine, newmark), "omega h > 0.2"));
  newmark.step = at(0.19);
  EXPECT_EQ(guard_refusal(machine, newmark), "");

  EXPECT_TRUE(says(guard_refusal(machine, method("central-difference", at(2.001))), "omega h > 2"));
  EXPECT_EQ(guard_refusal(machine, method("central-difference", at(1.999))), "");
}

TEST(StabilityGuard, ClosedContactsCountToo)
{
  // 2 kg with 100 Hz, and 1e8 N/m at the stop: 1127.9 Hz with the contact closed.
  const Machine machine = sliders({{100., 0.01}}, 1e8);
  const double  closed  = std::sqrt(std::pow(two_pi * 100., 2) + 5e7);
  const auto    message = guard_refusal(machine, method("central-difference", 2.01 / closed));
  EXPECT_TRUE(says(message, "mode 1 of the machine with closed contacts (1129.")) << message;
  EXPECT_EQ(guard_refusal(machine, method("central-difference", 1.99 / closed)), "");

  // Exact propagation: a warning only, and only for a force that is not the mean one.  The contact alone counts.
  MethodOptions        exact    = method("exact", 3.47 / std::sqrt(5e7), 2, {{"force", "linear"}});
  const LinearSpectrum spectrum = linear_spectrum(machine, at_rest(machine));
  const auto           warnings = [&] { return StabilityGuard(spectrum, exact).warnings(); };
  EXPECT_EQ(guard_refusal(machine, exact), "");
  ASSERT_EQ(warnings().size(), 1u);
  EXPECT_TRUE(says(warnings()[0], "omega h > 3.46")) << warnings()[0];
  exact.step = 3.45 / std::sqrt(5e7);
  EXPECT_TRUE(warnings().empty());
  exact.step = 10. / std::sqrt(5e7);
  exact.set("force", "average");
  EXPECT_TRUE(warnings().empty());
}

TEST(StabilityGuard, AccuracyOfEveryMode)
{
  const Machine        machine  = sliders({{20., 0.02}, {300., 0.01}}, 1e8);
  const LinearSpectrum spectrum = linear_spectrum(machine, at_rest(machine));
  const auto           modes    = StabilityGuard(spectrum, bdf(2, 1e-4)).modes();
  ASSERT_EQ(modes.size(), 4u); // two open, two closed
  EXPECT_NEAR(modes[0].mode.omega, two_pi * 20., 1e-9);
  EXPECT_NEAR(modes[1].omega_h, two_pi * 0.03, 1e-12);
  // docs/theory/integration.md (11): (omega h)^2/3 in the period, (omega h)^3/4 in damping, leading terms.
  EXPECT_NEAR(modes[0].period_error, std::pow(modes[0].omega_h, 2) / 3., 0.02 * modes[0].period_error);
  EXPECT_EQ(modes[3].origin, ModeOrigin::closed);

  // Under exact propagation the open machine has no error at all, the closed one that of its contact.
  const auto carried = StabilityGuard(spectrum, method("exact", 1e-4, 2, {{"force", "average"}})).modes();
  EXPECT_EQ(carried[0].period_error, 0.);
  EXPECT_EQ(carried[1].numerical_damping, 0.);
  EXPECT_NEAR(carried[2].period_error, 0., 1e-12); // 300 Hz takes no part in the contact
  EXPECT_GT(carried[3].period_error, 1e-3);
}

// --- joints

/// A slider of 1 kg on a spring, geared to another one: their motions are alike but for the sign.
Machine geared(double stiffness, double other_mass)
{
  MachineModel  model;
  const Measure a = slider(model, "a", 1.), b = slider(model, "b", other_mass);
  model.add_linear("spring", a, {stiffness, 0., 0., 0.}, "N");
  model.attach("gear", std::make_shared<LinearJoint>(std::vector<double>{1., 1.}), {a, b});
  return Machine(std::move(model));
}

TEST(StabilityGuard, TakesTheModesThatIdealJointsLeave)
{
  const Machine        machine  = geared(1e8, 99.); // 1591.5 Hz without its gear, 159.15 Hz with it
  const double         omega    = std::sqrt(1e8 / 100.);
  const LinearSpectrum spectrum = linear_spectrum(machine, at_rest(machine));
  const auto           modes    = StabilityGuard(spectrum, bdf(2, 1e-5)).modes();
  ASSERT_EQ(modes.size(), 1u);
  EXPECT_NEAR(modes[0].mode.omega, omega, 1e-9 * omega);

  // BDF 3 grows for 0 < omega h < 1.936: with its gear the machine grows where it would not without, and is stable
  // where it would grow.
  EXPECT_TRUE(says(guard_refusal(machine, bdf(3, 1. / omega)), "(159.15 Hz, damping ratio 0)"));
  EXPECT_EQ(guard_refusal(machine, bdf(3, 2. / omega)), "");
  EXPECT_EQ(guard_refusal(geared(1e4, 0.01), bdf(3, 0.0196)), "");
  EXPECT_TRUE(says(guard_refusal(geared(1e4, 0.01), bdf(3, 0.0193)), "unstable"));
}

TEST(StabilityGuard, NewmarkNeedsDampedJoints)
{
  const Machine machine = geared(1e8, 99.);
  MethodOptions newmark = method("newmark", 1e-5, 2, {{"gamma", 0.7}, {"beta", 0.36}});
  EXPECT_NO_THROW(make_integrator(machine, newmark));
  for (const double beta : {0.2, 0.35})
  {
    newmark.set("beta", beta);
    EXPECT_THROW(make_integrator(machine, newmark), std::invalid_argument) << beta;
  }
}

// --- dampers

/// Two sliders of 1 kg on springs of 100 Hz with another between them; the first one has a damper.
Machine one_damped(double damping)
{
  MachineModel  model;
  const Measure a = slider(model, "a", 1.), b = slider(model, "b", 1.);
  const double  c = std::pow(two_pi * 100., 2);
  model.add_linear("spring a", a, {c, damping, 0., 0.}, "N");
  model.add_linear("spring b", b, {c, 0., 0., 0.}, "N");
  model.add_linear("spring", {a[0], {b[0].first, -1.}}, {0.2 * c, 0., 0., 0.}, "N");
  return Machine(std::move(model));
}

TEST(StabilityGuard, ADamperDoesNotReachWhatItHoldsStill)
{
  // A strong damper holds the first mass; the second one swings undamped against it, while v^T B v gives both modes a
  // high damping ratio.
  const Machine machine = one_damped(1e6);
  const double  omega   = two_pi * 100. * std::sqrt(1.2);

  MethodOptions wilson = method("wilson", 0., 2, {{"theta", 1.2}});
  const auto    limit  = unstable_intervals(wilson, 0.).at(0).from;
  wilson.step          = 1.01 * limit / omega;
  EXPECT_TRUE(says(guard_refusal(machine, wilson), "unstable"));
  wilson.step = 0.99 * limit / omega;
  EXPECT_EQ(guard_refusal(machine, wilson), "");

  // Newmark's grows from omega h = 2 zeta / 0.05 on: with all of the damping at 250.
  EXPECT_TRUE(says(guard_refusal(machine, method("newmark", 0.1 / omega, 2, {{"gamma", 0.45}})), "unstable"));
  EXPECT_TRUE(says(guard_refusal(machine, bdf(4, 1. / omega)), "unstable"));
}

TEST(DampedModes, AreThoseOfTheWholeStateMatrix)
{
  // Eight modes, in pairs that dampers couple hardly, strongly, and so that they do not vibrate.
  const Eigen::Index p = 8;
  DenseModes         modes{Eigen::VectorXd(p), Eigen::MatrixXd::Identity(p, p), Eigen::VectorXd::Zero(p)};
  modes.omega << 0., 10., 11., 50., 200., 201., 3000., 1e5;
  Eigen::MatrixXd w = Eigen::MatrixXd::Zero(p, 3);
  w.col(0) << 0., 1., 1., 0.1, 0.1, 0., 1., 1.;
  w.col(1) << 0., 0., 0., 5., 5., -5., 0., 0.;
  w.col(2) << 0.2, 0., 0., 0., 0., 30., 30., 2.;
  const Eigen::MatrixXd B = w * w.transpose();

  Eigen::MatrixXd A(2 * p, 2 * p);
  A << Eigen::MatrixXd::Zero(p, p), Eigen::MatrixXd(modes.omega.asDiagonal()),
      Eigen::MatrixXd((-modes.omega).asDiagonal()), -B;
  std::vector<std::complex<double>> whole;
  for (const auto &s : A.eigenvalues())
    if (s.imag() > 1e-6 * std::abs(s))
      whole.push_back(s);
  std::sort(whole.begin(), whole.end(), [](auto a, auto b) { return std::abs(a) < std::abs(b); });

  const auto found = damped_modes(modes, B, {1e-6, 1e-4});
  ASSERT_EQ(found.size(), whole.size());
  for (std::size_t j = 0; j < found.size(); ++j)
  {
    EXPECT_NEAR(found[j].line.omega, std::abs(whole[j]), 2e-6 * std::abs(whole[j])) << j;
    const double zeta = -whole[j].real() / std::abs(whole[j]);
    EXPECT_NEAR(found[j].line.zeta, zeta, 2e-4 * zeta) << j;
  }
}

// --- laws that stiffen

/// A ball of 1 kg that meets a stop after Hertz with 10 m/s.
Machine ball_and_stop(double stiffness)
{
  MachineModel                     model;
  const Measure                    u = slider(model, "ball", 1.);
  mechanism::Clearance::Parameters stop;
  stop.gap       = 0.1;
  stop.stiffness = stiffness;
  stop.exponent  = 1.5;
  stop.stops     = mechanism::Clearance::Stops::above;
  model.attach("stop", std::make_shared<mechanism::Clearance>(stop), {u});
  return Machine(std::move(model));
}

RunResult thrown(const MethodOptions &method)
{
  Machine machine = ball_and_stop(1e10);
  return simulate(machine, start(0., 10.), run_of(method, 0.04), {machine.signal("v", "ball.velocity")});
}

TEST(StiffnessCheck, EndsARunInAContactThatBecomesTooStiffForItsStep)
{
  const auto rebound = [](const RunResult &run) { return std::abs(run.signals.at(0).final); };
  for (MethodOptions method : {method("central-difference", 1e-3), method("newmark", 1e-3, 2, {{"beta", 0.1}}),
                               method("wilson", 1e-3, 2, {{"theta", 1.2}})})
  {
    const RunResult ended = thrown(method);
    EXPECT_TRUE(says(ended.failure, "\"stop\"")) << method_name(method) << ended.failure;
    const auto at = ended.failure.find("use run.step = ");
    ASSERT_NE(at, std::string::npos);
    method.step           = std::stod(ended.failure.substr(at + 15));
    const RunResult taken = thrown(method);
    EXPECT_EQ(taken.failure, "") << method_name(method);
    EXPECT_LT(rebound(taken), 10.5) << method_name(method); // it came with 10 m/s
  }
  EXPECT_EQ(thrown(method("newmark", 1e-3)).failure, ""); // average acceleration stands any stiffness
}

TEST(StabilityGuard, DampersThatJoinModesAreSeenByBdf)
{
  // Two equal masses, springs to the ground, a damper between them: v^T B v gives both modes of the degenerate pair
  // some damping if they are mixed, but the common motion has none.  BDF 3 must see it.
  MachineModel  model;
  const Measure a = slider(model, "a", 1.), b = slider(model, "b", 1.);
  model.add_linear("spring a", a, {1e6, 0., 0., 0.}, "N");
  model.add_linear("spring b", b, {1e6, 0., 0., 0.}, "N");
  model.add_linear("damper", {a[0], {b[0].first, -1.}}, {0., 400., 0., 0.}, "N"); // ratio 0.4
  EXPECT_TRUE(says(guard_refusal(Machine(std::move(model)), bdf(3, 1e-3)), "unstable"));
}

} // namespace
} // namespace gestell::tests
