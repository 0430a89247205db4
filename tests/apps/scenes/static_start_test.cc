// Where machines come to rest: behind play, on contacts, far from where they are described; and where they would not
// stay.

#include "tests/support/scene_motion.h"

#include "apps/scene/build/build_machine.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

constexpr double g_earth = 9.81;

const std::string gravity        = "gravity = [0, 0, -9.81]\n";
const std::string at_rest        = "[start]\nrule = \"static\"\n";
const std::string start_settings = "[run]\nstep = \"1 ms\"\nend = \"20 ms\"\n[output]\npicture_step = 0\n";

/// The first row of a run from the static start, which must be at rest until its end.
void expect_rest(const SceneRun &motion, const std::vector<double> &values, double tolerance)
{
  EXPECT_EQ(motion.result.failure, "");
  for (const std::size_t row : {std::size_t(0), motion.n_rows() - 1})
    for (std::size_t i = 0; i < values.size(); ++i)
      EXPECT_NEAR(motion.at(row, i + 1), values[i], tolerance) << motion.result.columns[i + 1] << " in row " << row;
}

bool reported(const SceneRun &motion, const std::string &words)
{
  for (const std::string &warning : coupling::texts_of(motion.result.findings))
    if (warning.find(words) != std::string::npos)
      return true;
  return false;
}

/// 10 kg that fall along -z onto an element.
SceneRun dropped(const std::string &element)
{
  return run(gravity + "[body.s]\ntype = \"slider\"\naxis = [0, 0, -1]\nmass = 10\n[element.e]\nfrom = \"s\"\n" +
             element + at_rest + start_settings + "signals = { x = \"s.displacement\" }\n");
}

TEST(StaticStart, WarnsOfVelocitiesThatHaveNoPartInIt)
{
  const auto moving = [](const std::string &v)
  {
    return run(gravity + slider_body("s", "10", "[0, 0, -1]") +
               element("e", "spring-damper", {{"from", "s"}, {"stiffness", "1e4"}}) +
               start("rule = 'static'\nv = { s = " + v + " }") + start_settings +
               "signals = { x = 's.displacement' }\n");
  };
  EXPECT_TRUE(reported(moving("1"), "start.v is not used with rule = \"static\""));
  EXPECT_FALSE(reported(moving("0"), "start.v"));
}

TEST(StaticStart, ClosesWhatWasOpen)
{
  const double W = 10. * g_earth;
  expect_rest(dropped("type = \"stop\"\ngap = \"10 mm\"\nstiffness = 1e6\n"), {0.01 + W / 1e6}, 1e-11);
  expect_rest(dropped("type = \"stop\"\ngap = \"10 mm\"\nstiffness = 1e9\nexponent = 1.5\n"),
              {0.01 + std::pow(W / 1e9, 2. / 3.)}, 1e-11);
  expect_rest(dropped("type = \"rope\"\nstiffness = 1e5\nslack = \"20 mm\"\n"), {0.02 + W / 1e5}, 1e-11);
  expect_rest(dropped("type = \"clearance\"\nstiffness = 1e5\ngap = \"20 mm\"\n"), {0.02 + W / 1e5}, 1e-11);
}

TEST(StaticStart, AJournalLiesInItsBearing)
{
  const auto motion = run(gravity + planar_body("p", "10", "0.1", "[0, 0, 0]") +
                          element("b", "journal bearing",
                                  {{"from", "ground"},
                                   {"to", "p"},
                                   {"at", "[0, 0, 0]"},
                                   {"axis", "[0, 1, 0]"},
                                   {"clearance", "1 mm"},
                                   {"radius", "20 mm"},
                                   {"stiffness", "1e6"}}) +
                          at_rest + start_settings + "signals = { z = \"p.uz\", x = \"p.ux\", angle = \"p.angle\" }\n");
  expect_rest(motion, {-1e-3 - 10. * g_earth / 1e6, 0., 0.}, 1e-10); // the angle, which nothing holds, stays
}

std::string pendulum(const std::string &angle)
{
  return gravity + planar_body("p", "2", "0.5", "[0, 0, -1]") + revolute("j", "ground", "p", "[0, 0, 0]") + at_rest +
         "q = { \"p.angle\" = \"" + angle + "\" }\n" + start_settings + "signals = { a = \"p.angle\" }\n";
}

TEST(StaticStart, APendulumFallsToWhereItHangs)
{
  const double tolerance = 1e-9;
  expect_rest(run(pendulum("90 deg")), {0.}, tolerance);
  expect_rest(run(pendulum("-100 deg")), {0.}, tolerance);
  const auto nearby = run(pendulum("178 deg")); // Newton's method finds 180 degrees
  expect_rest(nearby, {0.}, tolerance);
}

TEST(StaticStart, OnItsHeadItStaysWithAWarningOfTheGrowth)
{
  const auto   motion = run(pendulum("180 deg"));
  const double growth = std::sqrt(2. * g_earth / (0.5 + 2.));
  EXPECT_NEAR(motion.at(0, 1), M_PI, 1e-9);
  EXPECT_TRUE(reported(motion, "unstable equilibrium"));
  EXPECT_TRUE(reported(motion, "p."));
  std::ostringstream rate;
  rate.precision(3);
  rate << "exp(" << growth << " t/s)";
  EXPECT_TRUE(reported(motion, rate.str()));
}

TEST(StaticStart, AChainDescribedHorizontallyHangs)
{
  std::string chain = gravity;
  for (int i = 1; i <= 5; ++i)
  {
    const std::string body = "b" + std::to_string(i);
    chain += planar_body(body, "1", "0.1", vector(i - 0.5, 0., 0.)) +
             revolute("j" + std::to_string(i), i == 1 ? "ground" : "b" + std::to_string(i - 1), body,
                      vector(i - 1., 0., 0.));
  }
  const auto motion = run(chain + at_rest + start_settings + "signals = { x = \"b5.x\", z = \"b5.z\" }\n");
  expect_rest(motion, {0., -4.5}, 1e-9);
}

TEST(StaticStart, AWeightOnALongSpringHangsBelowItsHook)
{
  const auto motion =
      run(gravity + "\n" + point_body("p", "100", "[1, 0, 0]") + place("o", "ground", "[0, 0, 0]") +
          measure("d", "distance", {{"from", "o"}, {"to", "p"}}) +
          element("c", "spring-damper", {{"on", "d"}, {"rest", "1"}, {"stiffness", "300"}}) +
          element("y", "spring-damper", {{"from", "p"}, {"direction", "[0, 1, 0]"}, {"stiffness", "10"}}) + at_rest +
          start_settings + "signals = { x = \"p.x\", z = \"p.z\" }\n");
  expect_rest(motion, {0., -1. - 100. * g_earth / 300.}, 1e-9);
}

TEST(StaticStart, WhatFallsForEverIsRefusedByName)
{
  const std::string free = gravity + "[body.s]\ntype = \"slider\"\naxis = [0, 0, -1]\nmass = 10\n" + at_rest +
                           start_settings + "signals = { x = \"s.displacement\" }\n";
  expect_refusal([&] { run(free); }, "there is no static equilibrium: the motion of s");
}

/// Three masses of 1, 2 and 3 kg on springs of 1 and 2 kN/m, one behind the other along x; nothing holds them.
SceneRun pulled_chain(const std::string &start)
{
  return run(R"([frame]
mass = [[1, 0, 0], [0, 2, 0], [0, 0, 3]]
stiffness = [[1000, -1000, 0], [-1000, 3000, -2000], [0, -2000, 2000]]
[frame.interface.a]
rows = { ux = 1 }
[frame.interface.b]
rows = { ux = 2 }
[frame.interface.c]
rows = { ux = 3 }
)" + element("pull", "force", {{"from", "frame.c"}, {"to", "ground"}, {"direction", "[1, 0, 0]"}, {"constant", "12"}}) +
             start + "[run]\nstep = \"1 ms\"\nend = \"0.5 s\"\n[output]\npicture_step = 0\n" +
             "signals = { a = \"frame.a.ux\", b = \"frame.b.ux\", c = \"frame.c.ux\" }\n");
}

TEST(StaticStart, OfAMachineThatFloatsIsRelievedByItsInertia)
{
  // 12 N accelerate 6 kg by 2 m/s^2: the springs carry 2 N and 6 N, the centre of mass stays.
  const auto   motion = pulled_chain("[start]\nrule = \"static\"\ninertia_relief = true\n");
  const double ab = 2. / 1000., bc = 6. / 2000.;
  EXPECT_EQ(motion.result.failure, "");
  EXPECT_NEAR(motion.at(0, 2) - motion.at(0, 1), ab, 1e-12);
  EXPECT_NEAR(motion.at(0, 3) - motion.at(0, 2), bc, 1e-12);
  EXPECT_NEAR(motion.at(0, 1) + 2. * motion.at(0, 2) + 3. * motion.at(0, 3), 0., 1e-12);
  for (std::size_t row = 0; row < motion.n_rows(); row += 50) // it flies off without vibration
  {
    EXPECT_NEAR(motion.at(row, 2) - motion.at(row, 1), ab, 1e-9);
    EXPECT_NEAR(motion.at(row, 3) - motion.at(row, 2), bc, 1e-9);
  }
  EXPECT_TRUE(reported(motion, "the machine is unsupported in 1 rigid-body mode"));
  EXPECT_TRUE(reported(motion, "mean acceleration of [2, 0, 0] m/s^2"));
}

TEST(StaticStart, OfAMachineThatFloatsIsRefusedWithoutRelief)
{
  expect_refusal([&] { pulled_chain("[start]\nrule = \"static\"\n"); }, "inertia_relief = true");
}

} // namespace
} // namespace gestell::tests
