// Derivatives of runs by parameters, where the run is known in closed form.

#include "mechanism/elements/clearance.h"
#include "mechanism/elements/coulomb_friction.h"
#include "mechanism/elements/dynamic_motor.h"
#include "tests/coupling/sensitivity/twin_machines.h"
#include "tests/support/test.h"

namespace
{

using namespace gestell::coupling;
using Eigen::VectorXd;
using gestell::mechanism::Clearance;

RunOptions fine(double end)
{
  RunOptions options;
  options.method.tolerance = 1e-10;
  options.end              = end;
  options.output_step      = end / 100.;
  return options;
}

InitialState start(double q, double v)
{
  InitialState state;
  state.q = VectorXd::Constant(1, q);
  state.v = VectorXd::Constant(1, v);
  return state;
}

/// x = (m, c, q0): q = q0 cos(omega t), omega^2 = c/m.
Made oscillator(const VectorXd &x)
{
  MachineModel model;
  model.add_slider("x", {1., 0., 0.}, x[0], "ground");
  model.add_linear("spring", {{model.coordinate("x"), 1.}}, {x[1], 0., 0., 0.}, "N");
  Machine             machine(std::move(model));
  std::vector<Signal> signals = {machine.signal("q", "x.displacement"), machine.signal("F", "spring.force")};
  return {std::move(machine), start(x[2], 0.), std::move(signals)};
}

TEST(RunSensitivities, AreThoseOfTheOscillatorsSolution)
{
  const VectorXd x     = (VectorXd(3) << 2., 98., 0.01).finished();
  const double   omega = 7., T = 1., phi = omega * T;
  const auto     found = differentiated(oscillator, x, fine(T));

  // d omega/dm = -omega/2m, d omega/dc = omega/2c
  const VectorXd &of_end = found["q.final"].derivative;
  EXPECT_NEAR(of_end[0], -0.01 * std::sin(phi) * T * -omega / 4., 1e-7 * 0.01 * phi);
  EXPECT_NEAR(of_end[1], -0.01 * std::sin(phi) * T * omega / 196., 1e-7 * 0.01 * phi);
  EXPECT_NEAR(of_end[2], std::cos(phi), 1e-7);

  // The smallest value -q0 at half a period T/2 = pi/omega does not depend on m and c; its instant does.
  EXPECT_NEAR(found["q.min"].derivative[0], 0., 1e-8);
  EXPECT_NEAR(found["q.min"].derivative[2], -1., 1e-7);
  EXPECT_NEAR(found["q.t_min"].derivative[0], M_PI / omega / 4., 1e-5 * M_PI / omega);
  EXPECT_NEAR(found["q.t_min"].derivative[1], -M_PI / omega / 196., 1e-5 * M_PI / omega / 98.);
  EXPECT_NEAR(found["F.max"].derivative[1], found["F.max"].value / x[1], 1e-7);
}

/// x = (m, c, gap, v0): free flight to a stop, and half a sine in it.
Made bouncing(const VectorXd &x)
{
  MachineModel model;
  model.add_slider("x", {1., 0., 0.}, x[0], "ground");
  Clearance::Parameters stop;
  stop.gap       = x[2];
  stop.stiffness = x[1];
  stop.stops     = Clearance::Stops::above;
  model.attach("stop", std::make_shared<Clearance>(stop), {{{model.coordinate("x"), 1.}}});
  Machine             machine(std::move(model));
  std::vector<Signal> signals = {machine.signal("q", "x.displacement"), machine.signal("v", "x.velocity")};
  return {std::move(machine), start(0., x[3]), std::move(signals)};
}

/// By BDF of order 2 with fixed steps that are omega h of the half sine in the stop.
Differentiated by_fixed_steps(double omega_h)
{
  const VectorXd x = (VectorXd(4) << 3., 4800., 0.2, 0.8).finished();
  RunOptions     options;
  options.method.step = omega_h / 40.;
  options.end         = 0.5;
  return differentiated(bouncing, x, options);
}

TEST(RunSensitivities, OfAContactTooStiffForTheStepsOfTheRunGiveAWarning)
{
  // h^2/3 omega^3 (pi/omega) = (omega h)^2 pi/3: 0.17 and 2e-4 of steps of 0.4 and 0.014
  ASSERT_EQ(by_fixed_steps(0.4).found.warnings.size(), 1u);
  EXPECT_NE(by_fixed_steps(0.4).found.warnings.front().find("smaller run.step"), std::string::npos);
  EXPECT_TRUE(by_fixed_steps(0.014).found.warnings.empty());
}

TEST(RunSensitivities, SkipAContactWithTheTimeAtWhichItBegins)
{
  const double   m = 3., c = 4800., gap = 0.2, v = 0.8, omega = 40.;
  const VectorXd x     = (VectorXd(4) << m, c, gap, v).finished();
  const auto     found = differentiated(bouncing, x, fine(0.5));
  ASSERT_EQ(found.run.events.size(), 2u);

  // t_1 = gap/v, t_2 = t_1 + pi/omega, largest q = gap + v/omega at t_1 + pi/(2 omega)
  const VectorXd &t_1 = found["events.1.t"].derivative, &t_2 = found["events.2.t"].derivative,
                 &q = found["q.max"].derivative, &t_max = found["q.t_max"].derivative;
  EXPECT_NEAR(t_1[0], 0., 1e-12);
  EXPECT_NEAR(t_1[2], 1. / v, 1e-8);
  EXPECT_NEAR(t_1[3], -gap / (v * v), 1e-8);
  EXPECT_NEAR(t_2[0], M_PI / omega / (2. * m), 1e-7);
  EXPECT_NEAR(t_2[1], -M_PI / omega / (2. * c), 1e-7 / c);
  EXPECT_NEAR(t_2[2], 1. / v, 1e-7);
  EXPECT_NEAR(q[0], v / omega / (2. * m), 1e-8);
  EXPECT_NEAR(q[1], -v / omega / (2. * c), 1e-8 / c);
  EXPECT_NEAR(q[2], 1., 1e-7);
  EXPECT_NEAR(q[3], 1. / omega, 1e-8);
  EXPECT_NEAR(t_max[2], 1. / v, 1e-5);
  // Behind it the body flies back with -v: q(T) = gap - v (T - t_2)
  EXPECT_NEAR(found["q.final"].derivative[2], 1. + v * 1. / v, 1e-7);
  EXPECT_NEAR(found["v.final"].derivative[3], -1., 1e-7);
}

/// x = (mu g m, v0): slides to rest and sticks.
Made stopping(const VectorXd &x)
{
  MachineModel model;
  model.add_slider("x", {1., 0., 0.}, 2., "ground");
  gestell::mechanism::CoulombFriction::Parameters rubs;
  rubs.kinetic_force = rubs.static_force = x[0];
  model.attach("brake", std::make_shared<gestell::mechanism::CoulombFriction>(rubs), {{{model.coordinate("x"), 1.}}});
  Machine             machine(std::move(model));
  std::vector<Signal> signals = {machine.signal("q", "x.displacement")};
  return {std::move(machine), start(0., x[1]), std::move(signals)};
}

TEST(RunSensitivities, SkipSticking)
{
  const double    F = 6., v = 1.5, m = 2.;
  const auto      found = differentiated(stopping, (VectorXd(2) << F, v).finished(), fine(1.));
  const VectorXd &q = found["q.final"].derivative, &t = found["events.1.t"].derivative;
  // t = m v/F, q = m v^2/(2F)
  EXPECT_NEAR(t[0], -m * v / (F * F), 1e-7);
  EXPECT_NEAR(t[1], m / F, 1e-7);
  EXPECT_NEAR(q[0], -m * v * v / (2. * F * F), 1e-7);
  EXPECT_NEAR(q[1], m * v / F, 1e-7);
}

/// x = (scale of time): a motor starts, whose torque follows its characteristic with a lag; both rise, turn and fall.
Made starting(const VectorXd &x)
{
  MachineModel model;
  const double T  = x[0];
  const int rotor = model.add_rotor("rotor", {0., 0., 1.}, 0.5, 0., "ground"), torque = model.add_lag("lag", 0.1 * T);
  const gestell::mechanism::KlossMotor::Parameters motor{20. / (T * T), 0.2, 100. / T, 1.};
  model.attach("motor", std::make_shared<gestell::mechanism::DynamicMotor>(motor), {{{rotor, 1.}}, {{torque, 1.}}});
  Machine             machine(std::move(model));
  std::vector<Signal> signals = {machine.signal("M", "motor.torque"), machine.signal("w", "rotor.speed")};
  InitialState        at_rest;
  at_rest.q = at_rest.v = VectorXd::Zero(2);
  return {std::move(machine), at_rest, std::move(signals)};
}

TEST(RunSensitivities, OfInstantsAtWhichMasslessStatesTurnAreInProportionToAllTimes)
{
  const auto found = differentiated(starting, VectorXd::Constant(1, 1.), fine(6.));
  for (const std::string name : {"M.t_max", "w.t_max"})
  {
    ASSERT_LT(found[name].value, 5.9) << name; // it turns
    EXPECT_NEAR(found[name].derivative[0], found[name].value, 1e-5 * found[name].value) << name;
  }
  EXPECT_NEAR(found["M.max"].derivative[0], -2. * found["M.max"].value, 1e-6 * found["M.max"].value);
}

/// x = (m, c, v_0): q = cos(omega t) + v_0/omega sin(omega t), omega^2 = c/m, beside a mass of 1 g that rings at
/// 1e5 1/s, as all parameters do.
Made slow_and_ringing(const VectorXd &x)
{
  constexpr double mass = 1e-3, fast = 1e5, amplitude = 1e-4;
  MachineModel     model;
  const int        slow = model.add_slider("slow", {1., 0., 0.}, x[0], "ground"),
            rings       = model.add_slider("rings", {1., 0., 0.}, mass, "ground");
  model.add_linear("spring", {{slow, 1.}}, {x[1], 0., 0., 0.}, "N");
  model.add_linear("stiff", {{rings, 1.}}, {mass * fast * fast, 0., 0., 0.}, "N");
  Machine             machine(std::move(model));
  std::vector<Signal> signals = {machine.signal("q", "slow.displacement")};
  InitialState        initial;
  initial.q = (VectorXd(2) << 1., amplitude * x.sum()).finished();
  initial.v = (VectorXd(2) << x[2], 0.).finished();
  return {std::move(machine), initial, std::move(signals)};
}

TEST(RunSensitivities, OfInstantsOfASignalSlowBesideTheStepsAreKnown)
{
  // Over a step of a us the signal changes by (omega h)^2 = 1e-12, and over the shorter ways by rounding alone.
  const double omega = 1., v = 0.006;
  RunOptions   options;
  options.method.order  = 5;
  options.method.step   = 1e-6;
  options.end           = 0.012;
  const auto      found = differentiated(slow_and_ringing, (VectorXd(3) << 2., 2., v).finished(), options);
  const VectorXd &t     = found["q.t_max"].derivative;
  // t = atan(v_0/omega)/omega, dt/domega = -t/omega - v_0/(1 + v_0^2)
  const double of_omega = -std::atan(v) - v / (1. + v * v);
  EXPECT_NEAR(found["q.t_max"].value, std::atan(v), 1e-6 * v);
  EXPECT_NEAR(t[0], -of_omega * omega / 4., 1e-4 * v / 2.);
  EXPECT_NEAR(t[1], of_omega * omega / 4., 1e-4 * v / 2.);
  EXPECT_NEAR(t[2], 1. / (1. + v * v), 1e-4);
}

} // namespace
