// Friction in ideal joints: motions by hand, and the order of the method.

#include "tests/support/scene_motion.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using test::complaint;
using test::with;

// --- a mass on an inclined guide

const std::string pushed =
    start("v = { 'carriage.ux' = '1 m/s * cos(a)', 'carriage.uz' = '-1 m/s * sin(a)' }") + steps("1 ms", "0.4 s") +
    signals("F = 'guide.friction', v = 'guide.sliding_speed', N = 'guide.resultant', M = 'guide.torque'");
const std::string incline = "gravity = [0, 0, -9.81]\n[parameters]\na = '40 deg'\n" +
                            planar_body("carriage", "3 kg", "0.02 kg m^2", "[0, 0, 0]") +
                            joint("guide", "prismatic", "ground", "carriage", "[0, 0, 0]",
                                  {{"axis", "['cos(a)', 0, '-sin(a)']"}, {"friction", "0.25"}}) +
                            pushed;

TEST(GuideFriction, AcceleratesByTheLawOfCoulomb)
{
  const SceneRun motion = run(incline);
  const double   g = 9.81, a = 40. * M_PI / 180., N = 3. * g * std::cos(a);
  // From the first instant on: the multipliers of the start know the friction, which knows them.
  EXPECT_NEAR(motion.at(0, motion.column("N")), N, 1e-9 * N);
  EXPECT_NEAR(motion.at(0, motion.column("F")), -0.25 * N, 1e-9 * N);
  EXPECT_NEAR(motion.signal("v").final, 1. + 0.4 * g * (std::sin(a) - 0.25 * std::cos(a)), 1e-9);
  expect_closed_balance(motion, 1e-9);
}

TEST(GuideFriction, WorksWithTheMethodsOfNewmark)
{
  const SceneRun motion = run(incline, {"run.method=generalised-alpha", "run.rho_inf=0.8"});
  const double   a      = 40. * M_PI / 180.;
  EXPECT_NEAR(motion.signal("v").final, 1. + 0.4 * 9.81 * (std::sin(a) - 0.25 * std::cos(a)), 1e-8);
}

/// Without weight, in a guide of 0.2 m under a moment M0 of 2 N m.
std::string weightless(const std::string &at, const std::string &axis)
{
  return "[parameters]\na = '40 deg'\n" + planar_body("carriage", "3 kg", "0.02 kg m^2", "[0, 0, 0]") +
         joint("guide", "prismatic", "ground", "carriage", at,
               {{"axis", axis}, {"friction", "{ coefficient = 0.25, length = '0.2 m' }"}}) +
         element("moment", "force", {{"from", "carriage"}, {"about", "[0, 1, 0]"}, {"constant", "2 N m"}}) + pushed;
}

// A guide of length L holds a moment by two forces M/L at its ends, which rub.
TEST(GuideFriction, OfALongGuideCountsTheMoment)
{
  const std::string level  = weightless("[0, 0, 0]", "['cos(a)', 0, '-sin(a)']");
  const SceneRun    motion = run(level, {"run.end=0.1 s"});
  EXPECT_NEAR(motion.signal("F").final, -0.25 * 2. * 2. / 0.2, 1e-9);
  EXPECT_NEAR(motion.signal("v").final, 1. - 0.1 * 0.25 * 20. / 3., 1e-9);
}

/// Friction at the lever h to the centre of mass makes a moment itself: |M| = M0 + h F or M0 - h F by the direction.
std::string lever(const std::string &height)
{
  return weightless("[0, 0, '-" + height + "']", "[1, 0, 0]");
}

// F = k M0/(1 -+ k h), k = 2 mu/L = 2.5/m: the iteration converges by k h = 0.6.
TEST(GuideFriction, GrowsByTheMomentItMakes)
{
  for (const double way : {1., -1.})
  {
    const SceneRun motion =
        run(lever("0.24 m"), {"start.v={ \"carriage.ux\" = " + std::to_string(way) + " }", "run.end=0.1 s"});
    const double F = 2.5 * 2. / (1. - way * 0.6);
    EXPECT_NEAR(motion.at(0, motion.column("F")), -way * F, 1e-8);
    EXPECT_NEAR(motion.signal("v").final, way * (1. - 0.1 * F / 3.), 1e-7);
  }
}

TEST(GuideFriction, ThatJamsIsReported)
{
  const SceneRun motion = stopped(lever("0.6 m"), {"start.v={ \"carriage.ux\" = 1 }", "run.end=0.1 s"}); // k h = 1.5
  for (const char *words : {"no initial state", "the force of \"guide\"", "so that the joint jams"})
    EXPECT_NE(motion.result.failure.find(words), std::string::npos) << motion.result.failure;
  EXPECT_TRUE(motion.result.rows.empty());
  EXPECT_TRUE(std::isnan(motion.signal("v").final));
}

TEST(PlaneFriction, ActsAgainstTheSlidingInThePlane)
{
  const std::string puck =
      "gravity = [0, 0, -9.81]\n" + point_body("puck", "3 kg", "[0, 0, 0]") +
      joint("table", "in-plane", "ground", "puck", "[0, 0, 0]", {{"axis", "[0, 0, 1]"}, {"friction", "0.1"}}) +
      start("v = { 'puck.ux' = 3, 'puck.uy' = -4 }") + steps("1 ms", "1 s") +
      signals("vx = 'puck.vx', vy = 'puck.vy', F = 'table.friction'");
  const SceneRun motion = run(puck);
  const double   v      = 5. - 0.981;
  EXPECT_NEAR(motion.signal("vx").final, 0.6 * v, 1e-8);
  EXPECT_NEAR(motion.signal("vy").final, -0.8 * v, 1e-8);
  EXPECT_NEAR(motion.signal("F").final, 0.1 * 3. * 9.81, 1e-8);
}

// --- a pendulum in a pin that rubs

const std::string pendulum =
    "gravity = [0, 0, -9.81]\n" + planar_body("bar", "2 kg", "0.05 kg m^2", "[0, 0, '-0.5 m']") +
    revolute("pin", "ground", "bar", "[0, 0, 0]",
             {{"friction", "{ coefficient = 0.01, radius = '10 mm', speed = '0.1 um/s' }"}}) +
    start("q = { 'bar.angle' = 0.02 }") + steps("0.5 ms", "3 s") +
    signals("angle = 'bar.angle', M = 'pin.friction', N = 'pin.resultant'", {{"step", "0.5 ms"}});

// Small swings about two centres, +-mu r/l to either side: every half swing loses 2 mu r/l.
TEST(PinFriction, TakesTheSameFromEveryHalfSwing)
{
  const SceneRun      motion = run(pendulum);
  const std::size_t   angle  = motion.column("angle");
  std::vector<double> turns  = {0.02};
  for (std::size_t i = 1; i + 1 < motion.n_rows(); ++i)
  {
    const double x = motion.at(i, angle), before = motion.at(i - 1, angle), after = motion.at(i + 1, angle);
    if ((x - before) * (after - x) <= 0. && std::abs(std::abs(x) - std::abs(turns.back())) > 1e-5)
      turns.push_back(x);
  }
  ASSERT_GE(turns.size(), 4u);
  const double lost = 2. * 0.01 * 0.01 / 0.5; // 4e-4
  // Of that: sine and centrifugal force phi^2, 4e-4; v0 against r phi', 1e-7/6e-4 at most of a swing; rows 0.5 ms apart
  // miss the turning point by (w h/2)^2/2 of 0.02, 4e-8.
  for (std::size_t i = 1; i < 4; ++i)
    EXPECT_NEAR(std::abs(turns[i - 1]) - std::abs(turns[i]), lost, 5e-3 * lost) << i;
  EXPECT_NEAR(motion.signal("N").final, 2. * 9.81, 1e-2);
}

TEST(PinFriction, OfABodyInSpaceIsThatOfOneInAPlane)
{
  const std::string friction = "{ coefficient = 0.1, radius = '30 mm', speed = '1 mm/s' }",
                    gravity  = "gravity = [0, 0, -9.81]\n",
                    settings = steps("0.2 ms", "1 s") + signals("x = 'bar.ux', M = 'pin.friction'");
  const SceneRun in_plane    = run(gravity + planar_body("bar", "2 kg", "0.05 kg m^2", "[0, 0, -0.5]") +
                                   revolute("pin", "ground", "bar", "[0, 0, 0]", {{"friction", friction}}) +
                                   start("q = { 'bar.angle' = 0.6 }") + settings),
                 in_space    = run(
                        gravity + rigid_body("bar", "2 kg", "[0.05, 0.05, 0.01]", "[0, 0, -0.5]") +
                        revolute("pin", "ground", "bar", "[0, 0, 0]", {{"axis", "[0, 1, 0]"}, {"friction", friction}}) +
                        start("q = { 'bar.ry' = 0.6 }") + settings);
  // Angle and directors have errors of their own, of h^2: 4e-8 s^2 times x'' = 4 m/s^2 and the square of the frequency.
  EXPECT_NEAR(in_space.signal("x").final, in_plane.signal("x").final, 1e-5);
  EXPECT_NEAR(in_space.signal("M").max, in_plane.signal("M").max, 1e-4 * in_plane.signal("M").max);
  EXPECT_GT(in_plane.signal("M").max, 0.05);
}

// --- joints of more than one motion

const std::string ball =
    "gravity = [0, 0, -10]\n" + rigid_body("top", "3 kg", "[0.04, 0.04, 0.04]", "[0, 0, 0]") +
    joint("socket", "spherical", "ground", "top", "[0, 0, 0]",
          {{"friction", "{ coefficient = 0.2, radius = '10 mm' }"}}) +
    start("v = { 'top.wx' = 4, 'top.wy' = 8, 'top.wz' = -8 }") + steps("0.5 ms", "1 s") +
    signals("wx = 'top.wx', wy = 'top.wy', wz = 'top.wz', M = 'socket.friction', v = 'socket.sliding_speed'");

// A sphere in its socket: the torque r mu N opposes the spin, whatever its direction.
TEST(BallFriction, BrakesTheSpinAboutAnyAxis)
{
  const SceneRun motion = run(ball);
  const double   M = 0.01 * 0.2 * 30., w = 12. - M / 0.04;
  // Directors turn 0.005 rad per step: their error of second order over 10 rad of the way.
  EXPECT_NEAR(motion.signal("wx").final, w / 3., 1e-3);
  EXPECT_NEAR(motion.signal("wy").final, 2. * w / 3., 1e-3);
  EXPECT_NEAR(motion.signal("wz").final, -2. * w / 3., 1e-3);
  EXPECT_NEAR(motion.signal("M").final, M, 1e-6);
  EXPECT_NEAR(motion.signal("v").final, 0.01 * w, 1e-5);
  expect_closed_balance(motion, 1e-3);
  const SceneRun fine = run(ball, {"run.step=0.25 ms"});
  const auto     off  = [&](const SceneRun &run) { return std::abs(run.signal("v").final - 0.01 * w); };
  EXPECT_LT(off(fine), off(motion) / 3.);
}

// m r^2 = J: sliding along and around is braked alike, at the angle at which it began.
TEST(PinFriction, OfACylindricalJointActsAgainstTheSlidingOfItsSurface)
{
  const SceneRun motion = run("gravity = [0, 0, -10]\n" + rigid_body("top", "3 kg", "[0.03, 0.04, 0.04]", "[0, 0, 0]") +
                              joint("pin", "cylindrical", "ground", "top", "[0, 0, 0]",
                                    {{"axis", "[1, 0, 0]"}, {"friction", "{ coefficient = 0.2, radius = '0.1 m' }"}}) +
                              start("v = { 'top.ux' = 0.9, 'top.wx' = 12 }") + steps("0.5 ms", "0.5 s") +
                              signals("wx = 'top.wx', ux = 'top.vx', M = 'pin.friction', v = 'pin.sliding_speed'"));
  EXPECT_NEAR(motion.signal("M").final, 0.2 * 30., 1e-6);
  EXPECT_NEAR(motion.signal("v").final, 1.5 - 1., 1e-4);
  EXPECT_NEAR(motion.signal("ux").final, 0.9 / 3., 1e-4);
  EXPECT_NEAR(motion.signal("wx").final, 12. / 3., 1e-3);
}

/// A slider-crank with friction in its pins and its guide, driven by its own speed.
const std::string slider_crank =
    rotor_body("crank", "0.5 kg m^2", "[0, 1, 0]", {{"position", "[0, 0, 0]"}}) +
    planar_body("rod", "1 kg", "0.02 kg m^2", "[0, 0, '0.35 m']") +
    slider_body("ram", "2 kg", "[0, 0, 1]", {{"position", "[0, 0, '0.6 m']"}}) +
    revolute("pin", "crank", "rod", "[0, 0, '0.1 m']",
             {{"friction", "{ coefficient = 0.1, radius = '20 mm', speed = '50 mm/s' }"}}) +
    revolute("wrist", "rod", "ram", "[0, 0, '0.6 m']",
             {{"friction", "{ coefficient = 0.1, radius = '15 mm', speed = '50 mm/s' }"}}) +
    start("v = { crank = 30 }") + steps("1 ms", "0.3 s") + signals("angle = 'crank.angle', w = 'crank.speed'");

// Start values included; speed tells of wrong forces anywhere on the way.
TEST(PinFriction, KeepsTheOrderOfTheMethod)
{
  const auto at = [](const std::string &step)
  {
    const SceneRun motion = run(slider_crank, {"run.step=" + step});
    return std::array{motion.signal("angle").final, motion.signal("w").final};
  };
  const auto coarse = at("0.4 ms"), middle = at("0.2 ms"), fine = at("0.1 ms");
  for (int i = 0; i < 2; ++i)
    EXPECT_NEAR(std::log2(std::abs((coarse[i] - middle[i]) / (middle[i] - fine[i]))), 2., 0.3) << i;
}

TEST(PinFriction, ClosesTheBalanceOfEnergy)
{
  const auto lack = [](const std::string &step)
  {
    const SceneRun motion = run(slider_crank, {"run.step=" + step});
    EXPECT_GT(motion.result.energy.dissipated, 1.);
    return std::abs(motion.result.energy.residual) / motion.result.energy.dissipated;
  };
  const double coarse = lack("0.4 ms"), fine = lack("0.1 ms");
  EXPECT_LT(fine, 1e-4);
  EXPECT_LT(fine, coarse / 8.);
}

// A study of mu may begin at zero: all signals are there, and the motion is that of the ideal joint.
TEST(PinFriction, OfCoefficientZeroIsNone)
{
  const SceneRun motion = run(with(pendulum, "coefficient = 0.01", "coefficient = 0"), {"run.end=0.1 s"});
  EXPECT_EQ(motion.signal("M").min, 0.);
  EXPECT_EQ(motion.signal("M").max, 0.);
}

// Newton leaves out how friction follows the multipliers: what that costs.
TEST(PinFriction, NeedsFewIterations)
{
  const SceneRun motion = run(slider_crank, {"run.step=0.2 ms"});
  const auto    &work   = motion.result.work;
  RecordProperty("newton_per_step", std::to_string(double(work.newton) / double(work.steps)));
  EXPECT_LT(double(work.newton) / double(work.steps), 8.);
}

TEST(JointFrictionScene, RefusesWhatMakesNoSense)
{
  EXPECT_EQ(complaint(pendulum), "");
  expect_complaint(
      with(pendulum, "friction = { coefficient = 0.01, radius = \"10 mm\", speed = \"0.1 um/s\" }", "friction = 0.1"),
      "needs the radius of the surface");
  expect_complaint(with(pendulum, "radius = \"10 mm\", ", ""), "the key 'radius' is missing");
  expect_complaint(with(pendulum, "type = \"revolute\"", "type = \"rigid\""),
                   "is for joints of type \"revolute\", \"prismatic\", \"cylindrical\"");
  expect_complaint(with(pendulum, "coefficient = 0.01", "coefficient = -0.01"), "joint.pin.friction.coefficient");
  expect_complaint(with(pendulum, "speed = \"0.1 um/s\"", "length = \"0.1 m\""), "length");
}

} // namespace
} // namespace gestell::tests
