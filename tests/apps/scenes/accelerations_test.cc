// Accelerations as signals, against closed forms: bodies, places, measures, interfaces; every method; at jumps.

#include "tests/support/scene_motion.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

constexpr double omega = 20.; // [1/s] of 2 kg on 800 N/m

/// x = 10 mm cos(omega t).
std::string oscillator(const std::string &end)
{
  return slider(2., end) + "a = \"slide.acceleration\"\n[output]\npicture_step = 0\n" +
         "[element.spring]\ntype = \"spring-damper\"\nfrom = \"slide\"\nstiffness = \"800 N/m\"\n"
         "[start]\nq = { slide = \"10 mm\" }\n";
}

/// Largest |a + omega^2 x| over all rows: what the equation of motion says of every state, however good that is.
double off_the_equation_of_motion(const SceneRun &motion)
{
  double largest = 0.;
  for (std::size_t row = 0; row < motion.n_rows(); ++row)
    largest = std::max(largest, std::abs(motion.at(row, 3) + omega * omega * motion.at(row, 1)));
  return largest;
}

using Accelerations = ::testing::TestWithParam<Settings>;
INSTANTIATE_TEST_SUITE_P(Methods, Accelerations,
                         ::testing::Values(fixed, controlled, Settings{"run.method=newmark"},
                                           Settings{"run.method=hht", "run.alpha=-0.1"},
                                           Settings{"run.method=generalised-alpha"}, Settings{"run.method=wilson"},
                                           Settings{"run.method=central-difference"},
                                           Settings{"run.method=exact", "run.step=5 ms"}));

TEST_P(Accelerations, OfEveryMethodFollowTheEquationOfMotionFromTheFirstRowOn)
{
  const SceneRun motion = run(oscillator("0.5 s"), GetParam());
  const double   peak   = omega * omega * 0.01; // 4 m/s^2
  EXPECT_EQ(motion.signal("a").unit, "m/s^2");
  EXPECT_NEAR(motion.at(0, 3), -peak, 1e-12);
  EXPECT_LT(off_the_equation_of_motion(motion), 1e-11); // also in rows between the steps
  // (omega h)^2 = 4e-6 of fixed steps, over 10 rad.
  EXPECT_NEAR(motion.signal("a").final, -peak * std::cos(omega * 0.5), 1e-4 * peak);
  EXPECT_NEAR(motion.signal("a").max, peak, 2e-5 * peak);
  EXPECT_NEAR(motion.signal("a").min, -peak, 2e-5 * peak);
}

TEST_P(Accelerations, JumpWhereAForceDoesAndTellBothSides)
{
  const SceneRun motion = run(slider(2., "0.5 s") + "a = \"slide.acceleration\"\n" +
                                  "[element.push]\ntype = \"table force\"\nfrom = \"slide\"\nagainst = \"time\"\n"
                                  "table = [[0, \"10 N\"], [\"0.1234567 s\", \"10 N\"], [\"0.1234567 s\", \"-6 N\"]]\n",
                              GetParam());
  EXPECT_NEAR(motion.signal("a").max, 5., 1e-10);
  EXPECT_NEAR(motion.signal("a").min, -3., 1e-10);
  EXPECT_NEAR(motion.signal("a").t_min, 0.1234567, 1e-9);
}

// --- bodies in joints, places, measures

const std::string pendulum = "gravity = [0, 0, -9.81]\n" + planar_body("bar", "2 kg", "0.5 kg m^2", "[0, 0, '-1 m']") +
                             revolute("pin", "ground", "bar", "[0, 0, 0]") + place("tip", "bar", "[0, 0, '-1.5 m']") +
                             place("post", "ground", "['2 m', 0, 0]") +
                             measure("way", "distance", {{"from", "post"}, {"to", "tip"}}) +
                             start("q = { 'bar.angle' = 1 }") + steps("0.5 ms", "1 s") +
                             signals("phi = 'bar.angle', w = 'bar.speed', alpha = 'bar.acceleration', ax = 'bar.ax', "
                                     "az = 'bar.az', tx = 'tip.ax', tz = 'tip.az', s = 'way.value', r = 'way.rate', a "
                                     "= 'way.acceleration', X = 'tip.x', Z = 'tip.z', vx = 'tip.vx', vz = 'tip.vz'",
                                     {{"step", "10 ms"}});

using AccelerationsInJoints = ::testing::TestWithParam<Settings>;
INSTANTIATE_TEST_SUITE_P(Methods, AccelerationsInJoints,
                         ::testing::Values(fixed, controlled,
                                           Settings{"run.method=generalised-alpha", "run.rho_inf=0.8"}));

// J phi'' = -m g l sin(phi), and of a point at r on the bar: -r phi'^2 along it, r phi'' across.  Positive about y the
// bar turns towards -x.
TEST_P(AccelerationsInJoints, OfAPendulumAreRadialAndTangential)
{
  const SceneRun motion = run(pendulum, GetParam());
  // bdf takes multipliers from g'' = 0, as good as positions; those of generalised-alpha err by (omega h)^2 = 2e-6 of
  // some 10 m/s^2, several times.
  const bool   own = !GetParam().empty() && GetParam()[0].find("alpha") != std::string::npos;
  const double J = 0.5 + 2., limit = own ? 1e-4 : 1e-6;
  for (std::size_t row = 0; row < motion.n_rows(); ++row)
  {
    const double phi = motion.at(row, 1), w = motion.at(row, 2), alpha = -2. * 9.81 * std::sin(phi) / J;
    EXPECT_NEAR(motion.at(row, 3), alpha, limit) << row;
    for (const auto &[r, column] : {std::pair{1., 4}, std::pair{1.5, 6}})
    {
      EXPECT_NEAR(motion.at(row, column), r * (w * w * std::sin(phi) - alpha * std::cos(phi)), limit) << row;
      EXPECT_NEAR(motion.at(row, column + 1), r * (w * w * std::cos(phi) + alpha * std::sin(phi)), limit) << row;
    }
    // s s'' = d . d'' + d'^2 - s'^2, d from the post to the tip
    const double s = motion.at(row, 8), rate = motion.at(row, 9), dx = motion.at(row, 11) - 2., dz = motion.at(row, 12);
    const double v2 = motion.at(row, 13) * motion.at(row, 13) + motion.at(row, 14) * motion.at(row, 14);
    EXPECT_NEAR(motion.at(row, 10) * s, dx * motion.at(row, 6) + dz * motion.at(row, 7) + v2 - rate * rate, limit)
        << row;
  }
}

TEST(Accelerations, AreThoseAgainstSpaceWithoutGravity)
{
  const SceneRun motion = run("gravity = [0, 0, -9.81]\n" + point_body("ball", "3", "[0, 0, 0]") +
                              steps("1 ms", "0.1 s") + signals("z = 'ball.az', x = 'ball.ax'"));
  EXPECT_NEAR(motion.signal("z").min, -9.81, 1e-12);
  EXPECT_NEAR(motion.signal("z").max, -9.81, 1e-12);
  EXPECT_EQ(motion.signal("x").max, 0.);
}

// A frame of one mass with a rotor on it: what drives the rotor drives the frame back.
TEST(Accelerations, OfAnInterfaceAndOfWhatItCarries)
{
  const SceneRun motion = run(
      R"([frame]
mass = [[10, 0], [0, 4]]
stiffness = [[0, 0], [0, 0]]
[frame.interface.a]
rows = { ry = 1, uz = 2 }
)" + rotor_body("rotor", "2", "[0, 1, 0]", {{"on", "frame.a"}}) +
      element("motor", "force profile", {{"from", "rotor"}, {"to", "frame.a"}, {"profile", "6 N m"}}) +
      element("load", "force", {{"from", "frame.a"}, {"direction", "[0, 0, 1]"}, {"constant", "8 N"}}) +
      steps("1 ms", "0.1 s") +
      signals("frame = 'frame.a.ry_acceleration', rotor = 'rotor.acceleration', lift = '-frame.a.uz_acceleration'"));
  for (const auto &[name, value] : {std::pair{"frame", -0.6}, std::pair{"rotor", 3.}, std::pair{"lift", -2.}})
  {
    EXPECT_NEAR(motion.signal(name).min, value, 1e-12) << name;
    EXPECT_NEAR(motion.signal(name).max, value, 1e-12) << name;
  }
  EXPECT_EQ(motion.signal("frame").unit, "rad/s^2");
}

TEST(Accelerations, OfManySignalsAreThoseOfEachAlone)
{
  // A chain of 24: more rows than are worth a solution each, or a single one.
  constexpr int n = 24;
  std::string   chain, all;
  for (int i = 0; i < n; ++i)
  {
    const std::string name = "s" + std::to_string(i), next = "s" + std::to_string(i + 1);
    chain += slider_body(name, number(1. + 0.1 * i), "[1, 0, 0]");
    Keys keys = {{"from", name}, {"stiffness", "800"}, {"damping", "2"}, {"direction", "[1, 0, 0]"}};
    if (i + 1 < n)
      keys.push_back({"to", next});
    chain += element("e" + std::to_string(i), "spring-damper", keys);
    all += (i ? ", a" : "a") + std::to_string(i) + " = '" + name + ".acceleration'";
  }
  chain += start("q = { s3 = '10 mm', s20 = '-4 mm' }") + steps("1 ms", "0.2 s");
  const SceneRun many = run(chain + signals(all));
  for (const int i : {0, 3, 20})
  {
    const SceneRun one = run(chain + signals("a = 's" + std::to_string(i) + ".acceleration'"));
    ASSERT_EQ(one.n_rows(), many.n_rows());
    for (std::size_t row = 0; row < one.n_rows(); ++row)
      EXPECT_NEAR(one.at(row, 1), many.at(row, std::size_t(i) + 1), 1e-12 * 8.) << i << ", " << row;
  }
}

// --- bad input

TEST(Accelerations, NeedMassAndThrowNoSwitch)
{
  const auto massless = [](const std::string &coordinate, const std::string &coupling)
  {
    return run("[frame]\nmass = [[10, 0], [0, 0]]\nstiffness = [[1e4, " + coupling + "], [" + coupling +
               ", 1e3]]\n[frame.interface.a]\nrows = { ux = 1, ry = 2 }\n" +
               start("q = { 'frame.a.ux' = '1 mm', 'frame.a.ry' = " + number(-1e-6 * std::stod(coupling)) + " }") +
               steps("1 ms", "0.1 s") + signals("a = 'frame.a." + coordinate + "_acceleration', u = 'frame.a.ux'"));
  };
  for (const std::string coupling : {"0", "1e3"}) // 10 u'' = -(1e4 - coupling^2/1e3) u
  {
    const SceneRun motion = massless("ux", coupling);
    const double   c      = (1e4 - std::pow(std::stod(coupling), 2) / 1e3) / 10.;
    for (std::size_t row = 0; row < motion.n_rows(); ++row)
      EXPECT_NEAR(motion.at(row, 1), -c * motion.at(row, 2), 1e-12);
  }
  expect_refusal([&] { massless("ry", "0"); }, "\"frame.a.ry\" has no mass");
  const std::string thrown = oscillator("0.1 s") + "[switch.s]\nwhen = 'slide.acceleration'\nabove = '1 m/s^2'\n"
                                                   "tell = 'spring'\norder = 'off'\n";
  expect_refusal([&] { run(thrown); }, "is an acceleration");
}

} // namespace
} // namespace gestell::tests
