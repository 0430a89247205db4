// A motor runs up two rotors on an elastic shaft: the vibration that the start excites dies away while the angle grows
// without end, so that the angle is no measure of what an error means.

#include "mechanism/elements/coulomb_friction.h"
#include "mechanism/elements/kloss_motor.h"
#include "tests/support/methods.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace coupling;

constexpr double J_1 = 0.5, J_2 = 2., c = 800., b = 0.1; ///< [kg m^2, N m/rad, N m s/rad]

RunResult run_up(const std::string &method, int order, double tolerance)
{
  MachineModel model;
  const int    motor = model.add_rotor("motor", {0., 0., 1.}, J_1, 0., "ground"),
            load     = model.add_rotor("load", {0., 0., 1.}, J_2, 0., "ground");
  model.add_linear("shaft", {{motor, 1.}, {load, -1.}}, {c, 0., 0., 0.}, "N m");
  model.add_linear("drag", {{load, 1.}}, {0., b, 0., 0.}, "N m");
  model.attach("drive",
               std::make_shared<mechanism::KlossMotor>(mechanism::KlossMotor::Parameters{40., 0.15, 50. * M_PI, 1.}),
               {{{motor, 1.}}});
  Machine          machine(std::move(model));
  const RunOptions options = run_of(controlled(tests::method(method, 0., order), tolerance), 60.);
  return simulate(machine, at_rest(machine), options, {machine.signal("T", "shaft.torque")});
}

TEST(RunUp, OfAMotorReportsThePeakOfTheShaftByExactPropagationWithATolerance)
{
  const double peak = run_up("bdf", 5, 1e-9).signals[0].max;
  EXPECT_NEAR(peak, 295.4, 0.1);
  // The peak, after 167 periods of the shaft, is that of a passage in which errors add up; they follow the tolerance.
  EXPECT_NEAR(run_up("exact", 4, 1e-5).signals[0].max, peak, 0.02 * peak);
  EXPECT_NEAR(run_up("exact", 4, 1e-6).signals[0].max, peak, 0.002 * peak);
  EXPECT_NEAR(run_up("exact", 4, 1e-8).signals[0].max, peak, 0.0002 * peak);
}

TEST(RunUp, EndsWithTheTorqueOfTheLoad)
{
  // Vibrations died away: T = b omega, and the motor gives the same.
  for (const double tolerance : {1e-5, 1e-7})
  {
    const RunResult run = run_up("exact", 4, tolerance);
    EXPECT_NEAR(run.signals[0].final, 15.2415, 0.02) << tolerance;
    EXPECT_TRUE(run.findings.empty());
  }
}

TEST(DryFriction, WithoutLocatedEventsGivesAWarning)
{
  MachineModel  model;
  const Measure x = slider(model, "x", 5.);
  model.add_linear("spring", x, {2000., 0., 0., 0.}, "N");
  model.attach("floor", std::make_shared<mechanism::CoulombFriction>(mechanism::CoulombFriction::Parameters{10., 15.}),
               {x});
  Machine    machine(std::move(model));
  RunOptions options  = run_of(bdf(2, 1e-3), 0.1);
  options.events      = false;
  const RunResult run = simulate(machine, start(0.05, 0.), options, {machine.signal("x", "x.displacement")});
  ASSERT_FALSE(run.findings.empty());
  EXPECT_NE(run.findings[0].text.find("run.events = false, but the dry friction of \"floor\""), std::string::npos);
}

} // namespace
} // namespace gestell::tests
