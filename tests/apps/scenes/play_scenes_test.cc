// Journal with play, contact with a plane, guide with play: from the scene to the motion, against solutions by hand.

#include "tests/support/scene_motion.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using test::complaint;
using test::with;

// --- a point on a plane

const std::string ball =
    point_body("ball", "2 kg", "[0, 0, '0.1 m']") +
    element("floor", "contact",
            {{"from", "ball"},
             {"normal", "[0, 0, 1]"},
             {"through", "[0, 0, 0]"},
             {"stiffness", "4 kN/mm"},
             {"restitution", "0.6"},
             {"impact_speed", "1 m/s"}}) +
    start("v = { 'ball.ux' = '3 m/s', 'ball.uz' = '-1 m/s' }") + steps("5 us", "0.15 s") +
    signals("vx = 'ball.vx', vz = 'ball.vz', N = 'floor.normal_force', d = 'floor.distance'", {{"step", "1 ms"}});

/// (omega h)^2 of the ball on its contact, omega^2 = c/m: what BDF 2 is wrong by, in parts.
constexpr double by_step = 4e6 / 2. * 5e-6 * 5e-6;

// Without weight the ball keeps just the share of its normal speed that was asked for, and all of the tangential one.
TEST(PointOnPlane, KeepsTheShareOfItsSpeedThatWasAskedFor)
{
  const SceneRun motion = run(ball);
  EXPECT_NEAR(motion.signal("vz").final, 0.6, by_step);
  EXPECT_NEAR(motion.signal("vx").final, 3., 1e-9);
  EXPECT_NEAR(time_of(motion, "contact"), 0.1, 1e-12);
  EXPECT_EQ(count(motion, "separation"), 1);
  expect_closed_balance(motion, 2. * by_step);
}

// While it slides all the time the tangential impulse is mu times the normal one, m (1 + e) v.
TEST(PointOnPlane, LosesTheImpulseOfFriction)
{
  const SceneRun motion = run(with(ball, "restitution", "friction = 0.25\nrestitution"));
  EXPECT_NEAR(motion.signal("vz").final, 0.6, by_step);
  EXPECT_NEAR(motion.signal("vx").final, 3. - 0.25 * 1.6, by_step);
  expect_closed_balance(motion, 2. * by_step);
}

// Falls, and touches down at sqrt(2 h/g).
TEST(PointOnPlane, TouchDownIsLocated)
{
  const SceneRun motion =
      run("gravity = [0, 0, -9.81]\n" + with(ball, "\"ball.uz\" = \"-1 m/s\"", "\"ball.uz\" = 0"), {"run.step=20 us"});
  EXPECT_NEAR(time_of(motion, "contact"), std::sqrt(0.2 / 9.81), 1e-10);
}

/// A block on a slope of 30 degrees, in the equilibrium of the normal contact, slides down at 1 m/s.
const std::string slope =
    "gravity = [0, 0, -9.81]\n" +
    table("parameters",
          {{"a", "30 deg"}, {"weight", "4 kg * 9.81 m/s^2"}, {"c", "2 kN/mm"}, {"d", "weight*cos(a)/c"}}) +
    point_body("block", "4 kg", "[0, 0, 0]") +
    element("slope", "contact",
            {{"from", "block"},
             {"normal", "['sin(a)', 0, 'cos(a)']"},
             {"through", "[0, 0, 0]"},
             {"stiffness", "c"},
             {"friction", "{ coefficient = 0.2, speed = '0.1 mm/s' }"}}) +
    start("q = { 'block.ux' = '-d*sin(a)', 'block.uz' = '-d*cos(a)' }\nv = { 'block.ux' = '1 m/s * cos(a)', 'block.uz' "
          "= '-1 m/s * sin(a)' }") +
    steps("0.2 ms", "0.5 s") +
    signals("N = 'slope.normal_force', F = 'slope.friction_force', v = 'slope.sliding_speed'");

TEST(PointOnPlane, SlidesDownASlopeByTheLawOfCoulomb)
{
  const SceneRun motion = run(slope);
  const double   g = 9.81, a = M_PI / 6., N = 4. * g * std::cos(a);
  EXPECT_NEAR(motion.signal("N").min, N, 1e-8 * N);
  EXPECT_NEAR(motion.signal("N").max, N, 1e-8 * N);
  EXPECT_NEAR(motion.signal("F").final, 0.2 * N, 1e-8 * N);
  EXPECT_NEAR(motion.signal("v").final, 1. + 0.5 * g * (std::sin(a) - 0.2 * std::cos(a)), 1e-9);
  expect_closed_balance(motion, 1e-9);
}

// The block bounces on a slope that holds it, with friction that develops within 1e-11 m/s: a jump for any step.
TEST(PointOnPlane, AFailureOfAControlledStepNamesTheSpeedOfFriction)
{
  std::string steep = with(slope, "coefficient = 0.2, speed = \"0.1 mm/s\"", "coefficient = 0.7, speed = 1e-11");
  steep             = with(steep, "q = { \"block.ux\" = \"-d*sin(a)\", \"block.uz\" = \"-d*cos(a)\" }\n", "");
  steep             = with(steep, "\"1 m/s * cos(a)\", \"block.uz\" = \"-1 m/s * sin(a)\"", "-0.5, \"block.uz\" = 0.3");
  const SceneRun motion = stopped(with(steep, "step = \"0.2 ms\"", "tolerance = 1e-6"));
  EXPECT_NE(motion.result.failure.find("increase the 'speed' of its friction"), std::string::npos)
      << motion.result.failure;
}

// --- a start inside a contact

bool warned(const SceneRun &motion, const std::string &name)
{
  for (const std::string &warning : coupling::texts_of(motion.result.findings))
    if (warning.find("the initial state penetrates the contact of \"" + name + "\" by ") != std::string::npos)
      return true;
  return false;
}

TEST(StartInsideAContact, GivesAWarning)
{
  EXPECT_TRUE(warned(run(with(ball, "[start]\n", start("q = { 'ball.uz' = '-102 mm' }")), {"run.end=1 ms"}), "floor"));
  EXPECT_FALSE(warned(run(ball, {"run.end=1 ms"}), "floor"));
  EXPECT_FALSE(warned(run(with(ball, "[start]\n", start("q = { 'ball.uz' = '-100 mm' }")), {"run.end=1 ms"}), "floor"));
  for (const std::string contact : {"stop\"", "clearance\"\ngap = \"1 mm\""})
  {
    const auto begin = [&](const std::string &x)
    {
      return run(slider(2., "1 ms") + "[start]\nq = { slide = \"" + x +
                 "\" }\n[element.end]\nfrom = \"slide\"\nstiffness = \"1 kN/mm\"\ntype = \"" +
                 (contact[0] == 's' ? contact + "\ngap = \"1 mm\"" : contact) + "\n");
    };
    EXPECT_TRUE(warned(begin("1.5 mm"), "end")) << contact;
    EXPECT_FALSE(warned(begin("0.5 mm"), "end")) << contact;
  }
}

// --- journal

/// A disc that turns in a bearing on the ground, so heavy to turn that it keeps its speed; its contact lies where its
/// weight is held.
const std::string disc =
    "gravity = [0, 0, -9.81]\n" +
    table("parameters",
          {{"w", "98.1 N"}, {"psi", "atan(0.3)"}, {"d", "0.5 mm + w*cos(psi) / (1 kN/mm)"}, {"turn", "1"}}) +
    planar_body("disc", "10 kg", "1e6", "[0, 0, 0]") +
    element("bearing", "journal bearing",
            {{"from", "ground"},
             {"to", "disc"},
             {"at", "[0, 0, 0]"},
             {"axis", "[0, 1, 0]"},
             {"clearance", "0.5 mm"},
             {"radius", "30 mm"},
             {"stiffness", "1 kN/mm"},
             {"dissipation", "20 s/m"},
             {"friction", "0.3"}}) +
    start(
        "q = { 'disc.ux' = 'turn*d*sin(psi)', 'disc.uz' = '-d*cos(psi)' }\nv = { 'disc.angle' = 'turn * 40 rad/s' }") +
    steps("50 us", "0.2 s") +
    signals("N = 'bearing.normal_force', T = 'bearing.friction_force', F = 'bearing.force', angle = "
            "'bearing.contact_angle', e = 'bearing.eccentricity'");

// The journal climbs until the weight is held by the normal force and friction: at tan psi = mu from the lowest point.
// Turning about +y, its lowest point slides towards -x: friction pushes it to +x.
TEST(Journal, RestsInItsBearingAtTheAngleOfFriction)
{
  for (const double turn : {1., -1.})
  {
    const SceneRun motion = run(disc, {"parameters.turn=" + std::to_string(turn)});
    EXPECT_TRUE(warned(motion, "bearing")); // pressed by its weight, but nobody said that this is an equilibrium
    const double weight = 98.1, psi = std::atan(0.3);
    // The speed falls by mu N R t/J, 2e-7 rad/s, and tanh is 1: nothing moves.
    EXPECT_NEAR(motion.signal("F").final, weight, 1e-6 * weight);
    EXPECT_NEAR(motion.signal("N").final, weight * std::cos(psi), 1e-6 * weight);
    EXPECT_NEAR(motion.signal("T").final, -turn * weight * std::sin(psi), 1e-6 * weight);
    EXPECT_NEAR(motion.signal("e").final, 5e-4 + weight * std::cos(psi) / 1e6, 1e-11);
    for (const double angle : {motion.signal("angle").min, motion.signal("angle").max})
      EXPECT_NEAR(angle, M_PI / 2. - turn * psi, 1e-6); // from x about y, towards -z
  }
}

/// A pendulum whose pin is a journal, or an ideal joint.
const std::string pendulum_with_play = "gravity = [0, 0, -9.81]\n" +
                                       planar_body("bar", "2 kg", "0.05 kg m^2", "['0.4 m', 0, 0]") +
                                       steps("50 us", "0.4 s") + signals("angle = 'bar.angle'", {{"step", "1 ms"}});
const std::string journal_pin = element("pin", "journal bearing",
                                        {{"from", "ground"},
                                         {"to", "bar"},
                                         {"at", "[0, 0, 0]"},
                                         {"axis", "[0, 1, 0]"},
                                         {"clearance", "0.1 mm"},
                                         {"radius", "20 mm"},
                                         {"stiffness", "20 kN/mm"},
                                         {"restitution", "0.5"},
                                         {"impact_speed", "0.1 m/s"}});

TEST(Journal, OfABodyInSpaceIsThatOfOneInAPlane)
{
  const std::string journal =
      with(journal_pin, "radius", "friction = { coefficient = 0.2, speed = \"5 mm/s\" }\nradius");
  const std::string in_plane =
      with(pendulum_with_play, "angle = \"bar.angle\"", "x = \"bar.ux\", z = \"bar.uz\", F = \"pin.force\"") + journal;
  const std::string in_space =
      with(with(in_plane, "\"planar\"\nnormal = [0, 1, 0]", "\"rigid\""), "\"0.05 kg m^2\"", "[0.05, 0.05, 0.03]");
  const std::vector<std::string> first_contacts{"run.step=10 us", "run.end=40 ms"};
  const SceneRun                 plane = run(in_plane, first_contacts), space = run(in_space, first_contacts);
  EXPECT_GT(plane.signal("F").max, 20.);
  // Both have errors of h^2 of their own: of a blow that lasts 2 ms, (2 pi h/2 ms)^2 = 1e-3.
  EXPECT_NEAR(space.signal("F").max, plane.signal("F").max, 1e-3 * plane.signal("F").max);
  for (const char *signal : {"x", "z"})
    EXPECT_NEAR(space.signal(signal).final, plane.signal(signal).final, 1e-3 * std::abs(plane.signal("z").final));
}

// It falls through the play and hangs then: what differs is the play itself, and falls with it.
TEST(Journal, BecomesAnIdealRevoluteJointAsThePlayVanishes)
{
  const double ideal = run(pendulum_with_play + revolute("pin", "ground", "bar", "[0, 0, 0]")).signal("angle").final;
  const auto   with_play = [&](const std::string &play)
  {
    const SceneRun motion = run(pendulum_with_play + with(journal_pin, "0.1 mm", play));
    return std::abs(motion.signal("angle").final - ideal);
  };
  const double large = with_play("1 mm"), small = with_play("10 um");
  EXPECT_GT(large, 1e-4);
  // 100 times less play; the compliance of the contact, some 3 m g/c = 3 um of 0.4 m, remains.
  EXPECT_LT(small, 0.03 * large);
  EXPECT_LT(small, 1e-4);
}

// What the balance lacks falls with the square of the step of BDF 2, over contacts, separations and sliding.
TEST(Journal, BalanceOfEnergyClosesByTheOrderOfTheMethod)
{
  const std::string rubbing =
      with(journal_pin, "radius", "friction = { coefficient = 0.1, speed = \"5 mm/s\" }\nradius");
  const auto lack = [&](const std::string &step)
  {
    const SceneRun motion = run(pendulum_with_play + rubbing, {"run.step=" + step, "run.end=0.1 s"});
    EXPECT_GT(motion.result.energy.dissipated, 1e-4);
    EXPECT_GT(count(motion, "contact"), 1);
    return std::abs(motion.result.energy.residual) / motion.result.energy.dissipated;
  };
  const double coarse = lack("20 us"), fine = lack("5 us");
  EXPECT_LT(fine, 1e-3);
  EXPECT_LT(fine, coarse / 8.); // 16 for the order 2
}

// The example: the journal stays within the play and what it presses into the wall, and changes sides on the way.
TEST(Journal, OfTheExampleKnocksInsideItsPlay)
{
  const SceneRun motion("slider_crank_journal.toml", Settings{"run.end=0.1 s"});
  ASSERT_EQ(motion.result.failure, "");
  EXPECT_TRUE(motion.result.findings.empty());
  EXPECT_GT(count(motion, "contact"), 4);
  EXPECT_GT(motion.signal("ecc").max, 0.5e-3);
  EXPECT_LT(motion.signal("ecc").max, 0.5e-3 + motion.signal("F").max / 10e6); // part of the force is damping
  EXPECT_LT(motion.signal("ecc").min, 0.45e-3);
  expect_closed_balance(motion, 1e-3);
}

// --- guide with play

/// A slide 0.2 m long in a guide along x with 0.1 mm of play to either side, tilted by a moment.
const std::string guide =
    planar_body("slide", "5 kg", "0.04 kg m^2", "['0.3 m', 0, 0]") +
    element("guide", "guide with play",
            {{"from", "ground"},
             {"to", "slide"},
             {"at", "['0.3 m', 0, 0]"},
             {"axis", "[1, 0, 0]"},
             {"normal", "[0, 0, 1]"},
             {"length", "0.2 m"},
             {"gap", "0.1 mm"},
             {"stiffness", "10 kN/mm"},
             {"dissipation", "20 s/m"}}) +
    element("tilt", "force", {{"from", "slide"}, {"about", "[0, 1, 0]"}, {"constant", "30 N m"}}) +
    start("v = { 'slide.ux' = '0.5 m/s' }") + steps("10 us", "0.1 s") +
    signals(
        "rear = 'guide.rear.normal_force', front = 'guide.front.normal_force', v = 'slide.vx', turn = 'slide.angle'",
        {{"step", "0.1 ms"}});

// The moment turns the slide until two opposite corners hold it by M/L.
TEST(GuideWithPlay, HoldsAMomentByTwoOppositeCorners)
{
  const SceneRun motion = run(guide);
  // About +y the front, at +x, goes down: the lower plane pushes it up, the upper one pushes the rear down.
  EXPECT_NEAR(motion.signal("front").final, 150., 0.01);
  EXPECT_NEAR(motion.signal("rear").final, -150., 0.01);
  EXPECT_NEAR(motion.signal("turn").final, (1e-4 + 150. / 1e7) / 0.1, 1e-7);
  EXPECT_NEAR(motion.signal("v").final, 0.5, 1e-9);
  expect_closed_balance(motion, 1e-3);
}

// Pressed by both corners, the slide is held back by mu 2 M/L.
TEST(GuideWithPlay, RubsAtEveryCornerThatTouches)
{
  const SceneRun motion = run(with(with(guide, "dissipation", "friction = 0.1\ndissipation"), "0.5 m/s", "5 m/s"),
                              {"run.end=0.5 s", "run.step=50 us"});
  const auto    &rows   = motion.result;
  const double   h      = motion.at(1, 0) - motion.at(0, 0);
  std::size_t    v      = 0;
  while (rows.columns[v] != "v")
    ++v;
  const auto   row  = [&](double t) { return std::size_t(std::lround(t / h)); };
  const double held = (motion.at(row(0.35), v) - motion.at(row(0.45), v)) / 0.1;
  EXPECT_NEAR(held, 0.1 * 300. / 5., 1e-3 * held);
}

// --- what makes no sense

TEST(PlayScenes, RefuseWhatMakesNoSense)
{
  EXPECT_EQ(complaint(disc), "");
  EXPECT_EQ(complaint(ball), "");
  EXPECT_EQ(complaint(guide), "");
  expect_complaint(with(ball, "restitution", "at_from = [0, 0, 0]\nrestitution"), "the point of `from` is `at`");
  expect_complaint(with(disc, "to = \"disc\"", "to = \"ground\""), "is on 'ground', the body of `from`");
  expect_complaint(with(disc, "clearance = \"0.5 mm\"", "clearance = 0"), "element.bearing.clearance");
  expect_complaint(with(disc, "radius = \"30 mm\"\n", ""), "needs 'radius' of the journal");
  expect_complaint(with(disc, "at = [0, 0, 0]\n", ""), "needs 'at', the centre of the bearing");
  expect_complaint(with(disc, "axis = [0, 1, 0]", "axis = [1, 0, 0]"), "normal to the plane of \"disc\"");
  expect_complaint(with(disc, "friction = 0.3", "friction = { coefficient = 0.3, static = 0.4 }"),
                   "needs 'static' and 'stribeck_speed' together");
  expect_complaint(with(disc, "friction = 0.3", "friction = { coefficient = 0.3, static = 0.2, stribeck_speed = 1 }"),
                   "is below 'coefficient'");
  expect_complaint(with(disc, "dissipation", "restitution = 0.5\ndissipation"),
                   "needs 'restitution' and 'impact_speed' together");
  expect_complaint(with(ball, "from = \"ball\"", "from = \"ball\"\nto = \"ball\""), "a contact needs two bodies");
  expect_complaint(with(guide, "normal = [0, 0, 1]\nlength", "normal = [1, 0, 1]\nlength"), "perpendicular to 'axis'");
}

} // namespace
} // namespace gestell::tests
