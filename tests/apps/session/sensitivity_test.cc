// Derivatives of runs by entries of their scenes: names, units, what is refused, and quotients of converged runs.

#include "tests/apps/session/differentiated.h"
#include "tests/support/refusal.h"
#include "tests/support/scene_parts.h"
#include "tests/support/test.h"

#include <atomic>

namespace gestell::tests
{
namespace
{

using apps::SensitivityOutput;
using apps::SensitivityResult;
using apps::Session;

/// A mass flies to a stop and back, m = 3 kg, omega = 40 /s in the stop.
const std::string flight = "name = 'flight'\n" +
                           table("parameters", {{"m_1", "3 kg"},
                                                {"c", "4.8 kN/m"},
                                                {"gap", "200 mm"},
                                                {"v_0", "0.8 m/s"},
                                                {"idle", "1 m"},
                                                {"twice", "2*gap"},
                                                {"none", "0"}}) +
                           slider_body("mass", "m_1", "[1, 0, 0]") +
                           element("stop", "stop",
                                   {{"from", "mass"},
                                    {"to", "ground"},
                                    {"direction", "[1, 0, 0]"},
                                    {"side", "above"},
                                    {"gap", "gap"},
                                    {"stiffness", "c"}}) +
                           start("rule = 'given'\nq = { mass = 0 }\nv = { mass = 'v_0' }") +
                           table("run", {{"method", "bdf"}, {"tolerance", "1e-10"}, {"end", "0.5 s"}}) +
                           "[output.signals]\nq = 'mass.displacement'\nF = 'stop.force'\n";

class OfFlight : public ::testing::Test
{
protected:
  SensitivityResult found(const std::string &keys, std::vector<std::string> *warnings = nullptr) const
  {
    apps::Result result = differentiated(Session(path_), keys);
    if (warnings)
      *warnings = result.warnings;
    return sensitivities_of(result);
  }

  test::SceneFolder folder_;
  std::string       path_ = folder_.write("flight.toml", test::quoted(flight));
};

const SensitivityOutput &output(const SensitivityResult &found, const std::string &name)
{
  for (const SensitivityOutput &one : found.outputs)
    if (one.output == name)
      return one;
  throw std::out_of_range(name);
}

TEST_F(OfFlight, AllMeansTheNumbersAmongTheParametersThatAreNotZeroAndMatter)
{
  std::vector<std::string> warnings, keys;
  for (const auto &key : found("all", &warnings).keys)
    keys.push_back(key.key);
  EXPECT_THAT(keys, ::testing::ElementsAre("parameters.m_1", "parameters.c", "parameters.gap", "parameters.v_0"));
  EXPECT_THAT(warnings,
              ::testing::Contains(::testing::HasSubstr("on which no value of the scene depends: parameters.idle")));
  EXPECT_THAT(warnings, ::testing::Not(::testing::Contains(::testing::HasSubstr("refused"))));
  EXPECT_THAT(warnings, ::testing::Contains(::testing::HasSubstr("omits parameters that are 0")));
}

TEST_F(OfFlight, DerivativesComeInSiUnits)
{
  const SensitivityResult by_gap = found("parameters.gap");
  EXPECT_EQ(by_gap.keys[0].unit, "m");
  EXPECT_DOUBLE_EQ(by_gap.keys[0].value, 0.2);
  EXPECT_NEAR(output(by_gap, "events.1.t").derivative[0], 1. / 0.8, 1e-7);
  EXPECT_NEAR(output(by_gap, "events.1.t").percent(by_gap.keys[0], 0), 1., 1e-7);
}

TEST_F(OfFlight, ANumberOfAnElementIsAsGoodAsAParameter)
{
  const SensitivityResult both = found("parameters.c,element.stop.stiffness");
  EXPECT_NEAR(output(both, "q.max").derivative[0], output(both, "q.max").derivative[1], 1e-12);
}

TEST_F(OfFlight, AreThoseOfTheClosedSolution) // q_max = gap + v_0/omega
{
  const SensitivityResult by = found("parameters.v_0,parameters.c");
  EXPECT_NEAR(output(by, "q.max").value, 0.2 + 0.8 / 40., 1e-8);
  EXPECT_NEAR(output(by, "q.max").derivative[0], 1. / 40., 1e-8);
  EXPECT_NEAR(output(by, "q.max").derivative[1], -0.8 / 40. / 9600., 1e-11);
}

TEST_F(OfFlight, WhatIsNotANumberOfTheMachineIsRefusedByName)
{
  const auto refused = [&](const std::string &keys, const std::string &words)
  { expect_refusal([&] { differentiated(Session(path_), keys); }, words); };
  refused("parameters.gapp", "has no key \"gapp\"; did you mean 'gap'");
  refused("element.stop.stiffnes", "did you mean 'stiffness'");
  refused("element.stop.side", "\"above\" is not a number");
  refused("body.mass.axis", "is an array");
  refused("parameters.none", "is 0");
  refused("run.tolerance", "the integration of the run");
  refused("name", "the name of the scene");
  refused("parameters.m_1,parameters.m_1", "named twice");
  refused("parameters.m_1,", "with commas between them");
  refused(" ", "it is empty");
}

TEST_F(OfFlight, AnInterruptionKeepsTheRunAndWhatIsKnownByThen)
{
  std::atomic<bool>  stop{false};
  const apps::Watch  watch{[&](const std::string &phase, double) { stop = stop || phase == "sensitivities"; }, &stop};
  const apps::Result result = differentiated(Session(path_, {}, fem::Scripts::harmless, watch), "parameters.c");
  EXPECT_FALSE(result.run->interrupted);
  EXPECT_EQ(result.run->events.size(), 2u);
  EXPECT_TRUE(sensitivities_of(result).interrupted);
  EXPECT_TRUE(std::isnan(output(sensitivities_of(result), "q.max").derivative[0]));
  EXPECT_THAT(result.warnings,
              ::testing::Contains(::testing::HasSubstr("interrupted: sensitivities cover the motion")));
}

TEST_F(OfFlight, AMotionThatTouchesAStopHasNone)
{
  // Thrown up against gravity, the mass turns at the stop.
  const std::string grazing =
      test::with(test::with(test::quoted(flight), "name = 'flight'", "name = 'flight'\ngravity = [-1.6, 0, 0]"),
                 "end = '0.5 s'", "end = '1 s'");
  const std::string path    = folder_.write("grazing.toml", grazing);
  int               refused = 0; // rounding decides which of these speeds meets the stop at all
  for (const char *speed : {"0.8000000000001", "0.8000000000003", "0.8000000000005", "0.800000000001"})
  {
    const SensitivityResult result = sensitivities_of(
        differentiated(Session(path, {"parameters.v_0=" + std::string(speed) + " m/s"}), "parameters.c"));
    if (!result.failure.empty())
    {
      EXPECT_THAT(result.failure, ::testing::HasSubstr("touches its switching point"));
      ++refused;
    }
  }
  EXPECT_GT(refused, 0);
}

/// Derivative of an output by a parameter: quotient of four runs, error of order 4 in the share h of its value.
double quotient(const std::string &path, std::vector<std::string> overrides, const std::string &key,
                const std::string &text, double value, const std::string &name, double h)
{
  const auto at = [&](double share)
  {
    overrides.push_back(key + "=(" + text + ")*" + std::to_string(1. + share));
    const apps::Result run = Session(path, overrides).run();
    overrides.pop_back();
    if (name.compare(0, 7, "events.") == 0)
      return run.run->events.at(std::stoul(name.substr(7)) - 1).t;
    for (const auto &signal : run.run->signals)
      if (name == signal.name + ".min" || name == signal.name + ".max" || name == signal.name + ".final")
        return name.back() == 'n' ? signal.min : name.back() == 'x' ? signal.max : signal.final;
    throw std::out_of_range(name);
  };
  return (8. * (at(h) - at(-h)) - (at(2. * h) - at(-2. * h))) / (12. * h * value);
}

/// A cam at a given speed lifts a follower by h sin(phi) through a stiff spring.
const std::string stiff_cam =
    "name = 'stiff_cam'\n" + table("parameters", {{"w", "10 rad/s"}, {"h", "20 mm"}}) +
    rotor_body("cam", "0.02 kg m^2", "[0, 1, 0]") + slider_body("follower", "2 kg", "[0, 0, 1]") +
    measure("height", "along",
            {{"from", "follower"}, {"to", "ground"}, {"at_to", "[0, 0, 0]"}, {"direction", "[0, 0, 1]"}}) +
    measure("gap", "position function", {{"from", "cam.angle"}, {"to", "height"}, {"function", "h*sin(x)"}}) +
    element("contact", "spring-damper", {{"on", "gap"}, {"stiffness", "20 kN/mm"}, {"damping", "100 N s/m"}}) +
    joint("drive", "prescribed motion", {{"on", "cam.angle"}, {"motion", "{ speed = 'w' }"}}) +
    start("rule = 'given'\nv = { cam = 'w', follower = 'h*w' }") +
    table("run", {{"method", "bdf"}, {"tolerance", "1e-9"}, {"end", "0.53 s"}}) +
    "[output.signals]\nF = 'contact.force'\nM = 'drive.torque'\n";

TEST(Sensitivities, OfAStiffElementOnAMeasureThatTurnsHoldAcrossItToo)
{
  // Of a spring that is stiff enough z = h sin(wt), F = m z'' and M = F h cos(wt), but for (w^2 m/c) = 1e-5 and what
  // the tolerance leaves of s, times the stiffness.
  const test::SceneFolder folder;
  const auto              found =
      sensitivities_of(differentiated(Session(folder.write("cam.toml", test::quoted(stiff_cam))), "parameters.w"));
  const double m = 2., h = 0.02, w = 10., T = 0.53, phi = w * T;
  EXPECT_NEAR(std::abs(output(found, "F.final").derivative[0]),
              std::abs(m * h * (2. * w * std::sin(phi) + w * w * T * std::cos(phi))), 1e-3 * m * h * w * w);
  EXPECT_NEAR(output(found, "M.final").derivative[0],
              -m * h * h * (w * std::sin(2. * phi) + w * w * T * std::cos(2. * phi)), 1e-3 * m * h * h * w * w);
}

TEST(Sensitivities, OfTheCraneAreQuotientsOfConvergedRuns)
{
  // Joints, the limiter's switch on a joint's force, the braking profile.  Of the quotient by runs of order 4 some 1e-6
  // is rounding and the fourth power of the step.
  const std::string              path      = GESTELL_SOURCE_DIR "/apps/scenes/crane_minimal.toml";
  const std::vector<std::string> overrides = {"run.order=4", "run.step=1 ms", "run.end=3.4 s"};
  const auto result = sensitivities_of(differentiated(Session(path, overrides), "parameters.rope,parameters.r_K"));
  for (const std::string name : {"events.1.t", "Q4.max", "F_h.min", "q3.min"})
  {
    const SensitivityOutput &own     = output(result, name);
    const double             of_rope = quotient(path, overrides, "parameters.rope", "1.35 m", 1.35, name, 1e-3),
                 of_head             = quotient(path, overrides, "parameters.r_K", "2.8 m", 2.8, name, 1e-4);
    EXPECT_NEAR(own.derivative[0], of_rope, 1e-5 * std::abs(own.value) / 1.35) << name;
    EXPECT_NEAR(own.derivative[1], of_head, 1e-5 * std::abs(of_head)) << name;
  }
}

// Tyres that lift off: frequencies are those of the machine that stands, whatever branches the run leaves.
TEST(Sensitivities, OfFrequenciesAreThoseOfTheModesThatAreReported)
{
  const std::string crane = GESTELL_SOURCE_DIR "/apps/scenes/crane_minimal_lift.toml";
  const auto        found = [&](const std::string &rope)
  {
    return sensitivities_of(differentiated(
        Session(crane, {"parameters.rope=" + rope, "run.step=1 ms", "run.end=20 ms"}), "parameters.rope"));
  };
  const SensitivityResult here = found("1.35"), below = found("1.3499"), above = found("1.3501");
  for (const std::string mode : {"modes.1", "modes.2", "modes.3", "modes.4"})
  {
    const double slope = (output(above, mode).value - output(below, mode).value) / 2e-4;
    EXPECT_NEAR(output(here, mode).derivative[0], slope, 1e-6 * std::abs(slope)) << mode; // (1e-4 m/1.35 m)^2
  }
}

TEST(Sensitivities, OfThePressAreQuotientsOfConvergedRuns)
{
  // 14 events up to the smallest force.
  const std::string              path      = GESTELL_SOURCE_DIR "/apps/scenes/press_minimal.toml";
  const std::vector<std::string> overrides = {"run.tolerance=1e-11", "run.end=0.25 s"};
  const auto result = sensitivities_of(differentiated(Session(path, overrides), "parameters.c_P,parameters.s_cl"));
  for (const std::string name : {"events.13.t", "events.14.t", "F_P.min", "x2.final"})
  {
    const SensitivityOutput &own    = output(result, name);
    const double             of_rod = quotient(path, overrides, "parameters.c_P", "900 kN/mm", 9e8, name, 1e-3),
                 of_play            = quotient(path, overrides, "parameters.s_cl", "0.4 mm", 4e-4, name, 1e-3);
    EXPECT_NEAR(own.derivative[0], of_rod, 1e-6 * std::abs(own.value) / 9e8) << name;
    EXPECT_NEAR(own.derivative[1], of_play, 1e-6 * std::abs(own.value) / 4e-4) << name;
  }
}

TEST(Sensitivities, OfAChaoticMotionReportHowFarTheyHold)
{
  // The follower leaves the cam at every turn.
  const auto result =
      differentiated(Session(GESTELL_SOURCE_DIR "/apps/scenes/cam_follower.toml", {"run.end=2 s"}), "parameters.r_0");
  EXPECT_THAT(result.warnings, ::testing::Contains(::testing::AllOf(::testing::HasSubstr("chaotic or unstable"),
                                                                    ::testing::HasSubstr("it grew by a factor of"))));
}

TEST(Sensitivities, OfATorqueThatAClutchTakesAwayAreThoseBehind)
{
  // It falls from some 20 kN m to zero, exactly, which is its smallest value.
  const auto by_J = sensitivities_of(
      differentiated(Session(GESTELL_SOURCE_DIR "/apps/scenes/press_emergency_stop.toml"), "parameters.J2"));
  EXPECT_EQ(output(by_J, "M_T.min").value, 0.);
  EXPECT_EQ(output(by_J, "M_T.min").derivative[0], 0.);
  EXPECT_NE(output(by_J, "M_T.t_min").derivative[0], 0.);
}

} // namespace
} // namespace gestell::tests
