// Energy of whole runs: laws dissipate what they take, ideal joints nothing, and the error of a method stands in the
// residual.

#include "tests/support/scene_motion.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

/// A bar of 1 m on a pin without friction, 0.1 rad from where it hangs.
const std::string driven_pendulum = "gravity = [0, 0, -9.81]\n" +
                                    planar_body("bar", "1 kg", "(1/12) kg m^2", "[0, 0, '-0.5 m']") +
                                    revolute("pin", "ground", "bar", "[0, 0, 0]") + start("q = { 'bar.angle' = 0.1 }") +
                                    steps("0.1 s", "60 s") + signals("phi = 'bar.angle'");

/// 1 kg at 10 m/s between two elastic stops, half a metre apart; flies over a contact in a step.
const std::string ball = slider_body("ball", "1 kg", "[1, 0, 0]") +
                         element("stops", "clearance", {{"from", "ball"}, {"gap", "0.25 m"}, {"stiffness", "1e8"}}) +
                         start("v = { ball = 10 }") + steps("1 ms", "1 s", {{"events", "false"}}) +
                         signals("v = 'ball.velocity'");

std::vector<double> dissipated(const SceneRun &motion)
{
  const auto         &columns = motion.result.columns;
  const auto          column  = std::find(columns.begin(), columns.end(), "energy dissipated") - columns.begin();
  std::vector<double> values;
  for (std::size_t row = 0; row < motion.n_rows(); ++row)
    values.push_back(motion.at(row, std::size_t(column)));
  return values;
}

TEST(EnergyOfRuns, AnIdealJointDissipatesNothingWhateverTheMethodErrs)
{
  for (const char *method :
       {"run.order=1", "run.order=2", "run.order=4", "run.method=generalised-alpha", "run.method=hht"})
  {
    const SceneRun motion = run(driven_pendulum, {method, "run.force_unstable=true"}); // BDF 4 grows
    const auto    &energy = motion.result.energy;
    EXPECT_EQ(energy.input, 0.) << method;
    EXPECT_EQ(energy.dissipated, 0.) << method;
    EXPECT_GE(energy.residual, std::abs(energy.stored)) << method;
  }
}

TEST(EnergyOfRuns, AMethodThatMakesEnergyEndsTheRunAndIsNamed)
{
  const SceneRun motion = stopped(ball, {"run.method=newmark"});
  EXPECT_NE(motion.result.failure.find("a spurious energy gain: Newmark 0.25, 0.5 with a step of 0.001 s"),
            std::string::npos)
      << motion.result.failure;
  EXPECT_NE(motion.result.failure.find("use a smaller step"), std::string::npos) << motion.result.failure;
  EXPECT_FALSE(motion.result.rows.empty());
}

// A guide that is driven round: its joint feeds what the bob gains, m (omega r)^2/2 and the way up, and takes nothing.
TEST(EnergyOfRuns, ADrivenJointFeedsWhatTheMotionGains)
{
  const SceneRun motion = run(driven_pendulum + "[joint.drive]\ntype = \"prescribed motion\"\non = \"bar.angle\"\n"
                                                "motion = { function = \"2*t^2/s^2\" }\n",
                              {"run.step=1 ms", "run.end=2 s", "start.q={}"});
  const auto    &energy = motion.result.energy;
  EXPECT_EQ(energy.dissipated, 0.);
  EXPECT_NEAR(energy.input, energy.stored, 1e-4 * energy.stored);
}

// Multipliers of index 3 lose two orders where the step changes: those of a joint that feeds the motion follow from the
// equation of motion, whether somebody reads its torque or not.
TEST(EnergyOfRuns, ADrivenJointFeedsTheSameWhetherItsTorqueIsReadOrNot)
{
  const std::string driven =
      driven_pendulum +
      "[joint.drive]\ntype = \"prescribed motion\"\non = \"bar.angle\"\n"
      "motion = { function = \"0.1*sin(6*t/s)\" }\n" +
      element("spring", "spring-damper",
              {{"from", "bar"}, {"direction", "[1, 0, 0]"}, {"stiffness", "1 N/mm"}, {"damping", "1 N s/m"}});
  std::vector<double> input;
  for (const std::string read : {"bar.angle", "drive.torque"})
  {
    const SceneRun motion = run(
        driven, {"run.method=bdf", "run.tolerance=1e-6", "run.end=0.5 s", "start.q={}", "output.signals.phi=" + read});
    const auto &energy = motion.result.energy;
    EXPECT_LT(energy.residual, 1e-5 * energy.exchanged) << read;
    input.push_back(energy.input);
  }
  EXPECT_NEAR(input[0], input[1], 1e-9 * std::abs(input[1]));
}

TEST(EnergyOfRuns, AnElasticStopDissipatesNothingWhereTheStepSkipsIt)
{
  for (const char *method : {"bdf", "newmark", "hht", "wilson"})
  {
    const SceneRun motion = stopped(ball, {std::string("run.method=") + method});
    const auto    &energy = motion.result.energy;
    EXPECT_LE(energy.dissipated, 1e-12 * energy.exchanged) << method; // rounding of -p u' - dE/dt, step by step
    EXPECT_GT(energy.residual, 1.) << method;
  }
}

// Its power is never negative, and weights of integration are positive.
TEST(EnergyOfRuns, WhatAPassiveLawDissipatesNeverFalls)
{
  for (const char *method : {"bdf", "newmark", "hht", "wilson", "exact"})
    for (const char *step : {"1 ms", "0.2 ms"})
    {
      const SceneRun motion          = run(ball, {std::string("run.method=") + method, std::string("run.step=") + step,
                                                  "run.force_unstable=true", "element.stops.dissipation=0.05", "run.end=0.3 s"});
      const std::vector<double> lost = dissipated(motion);
      EXPECT_TRUE(std::is_sorted(lost.begin(), lost.end())) << method;
      EXPECT_GT(lost.back(), 0.) << method;
    }
}

} // namespace
} // namespace gestell::tests
