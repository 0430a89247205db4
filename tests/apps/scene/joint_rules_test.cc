// Rules of joints, carriers and switches, each on the smallest machine that shows it.

#include "tests/support/scene_motion.h"

#include "apps/scene/build/carried_bodies.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using test::complaint;

const std::string settings = steps("1 ms", "1 s") + "[output]\npicture_step = 0\n";

/// A slide that a driven rod pushes along x.
const std::string driven_slide =
    slider_body("slide", "2 kg", "[1, 0, 0]", {{"position", "['1 m', 0, 0]"}}) +
    joint("rod", "distance",
          {{"from", "ground"}, {"to", "slide"}, {"motion", "{ speed = '0.5 m/s', brake = { duration = '0.2 s' } }"}});

// The body's own point is where it is described; a switch may have the name of what it tells.
TEST(JointRules, ASwitchBrakesTheJointWhoseNameItHas)
{
  const auto motion = run(driven_slide +
                          "[switch.rod]\nwhen = \"slide.displacement\"\nabove = \"0.1 m\"\ntell = \"rod\"\n"
                          "order = \"brake\"\n" +
                          settings + "signals = { x = \"slide.displacement\", F = \"rod.force\" }\n");
  EXPECT_NEAR(time_of(motion, "switch"), 0.2, 1e-9);
  EXPECT_NEAR(time_of(motion, "braking_ends"), 0.4, 1e-9);
  EXPECT_NEAR(motion.signal("x").final, 0.1 + 0.5 * 0.5 * 0.2, 1e-9);
  EXPECT_NEAR(motion.signal("F").min, -2. * 0.5 / 0.2, 1e-6); // m a while it brakes
}

// A length moves from the begin of the run on, whenever that is.
TEST(JointRules, APrescribedLengthBeginsWithTheRun)
{
  const auto motion =
      run(driven_slide + steps("1 ms", "11 s", {{"begin", "10 s"}}) + signals("x = 'slide.displacement'"));
  EXPECT_NEAR(motion.signal("x").final, 0.5, 1e-9);
}

// A cross slide carries both motions into its joints: the ends of a rod of 5 m stay on a quarter circle.
TEST(JointRules, ACrossSlideCarriesBothItsDisplacements)
{
  const std::string cross = slider_body("x", "1 kg", "[1, 0, 0]", {{"position", "['3 m', 0, 0]"}}) +
                            slider_body("z", "1 kg", "[0, 0, 1]", {{"guide", "x"}, {"position", "['3 m', 0, '4 m']"}}) +
                            joint("rod", "distance", {{"from", "ground"}, {"to", "z"}}) + start("v = { z = '-1 m/s' }");
  const auto   motion = run(cross + settings + "signals = { x = \"x.displacement\", z = \"z.displacement\" }\n");
  const double x = 3. + motion.signal("x").final, z = 4. + motion.signal("z").final;
  EXPECT_NEAR(std::hypot(x, z), 5., 1e-9);
  EXPECT_GT(x, 3.5);
}

// A point has no rotation: welded to a body it rides along and does not hold its angle.
TEST(JointRules, APointWeldedToABodyLeavesItFreeToTurn)
{
  const std::string swing = "gravity = [0, 0, -9.81]\n" + planar_body("bar", "1 kg", "0.1 kg m^2", "['0.5 m', 0, 0]") +
                            point_body("bob", "1 kg", "['1 m', 0, 0]") +
                            revolute("hinge", "ground", "bar", "[0, 0, 0]") +
                            joint("weld", "rigid", "bar", "bob", "['1 m', 0, 0]");
  const auto motion =
      run(swing + settings + "signals = { phi = \"bar.angle\", x = \"bob.x\", y = \"bob.y\", z = \"bob.z\" }\n");
  EXPECT_GT(motion.signal("phi").max, 1.);
  EXPECT_NEAR(std::hypot(motion.signal("x").final, motion.signal("z").final), 1., 1e-9);
  EXPECT_NEAR(motion.signal("y").final, 0., 1e-12);
}

TEST(JointRules, WhatCannotBeFollowedIsRefused)
{
  const std::string arm = planar_body("arm", "1", "1", "[0, 0, 0]");
  EXPECT_NE(complaint(arm + "[element.lump]\ntype = \"point mass\"\non = \"arm\"\nmass = 1\noffset = [1, 0, 0]\n")
                .find("would rotate with it"),
            std::string::npos);
  expect_refusal([&] { run(driven_slide + "[start]\nrule = \"steady\"\n" + settings); }, "do not work with joints");
}

/// A four-bar linkage of bodies in space: cranks of 0.1 and 0.3 m on the ground, a coupler between them.
std::string four_bar(const std::string &fourth)
{
  const auto hinge = [](const std::string &name, const std::string &from, const std::string &to, const std::string &at)
  {
    return revolute(name, from, to, at, {{"axis", "[0, 1, 0]"}});
  };
  return rigid_body("crank", "1", "[1, 1, 1]", "[0, 0, 0.05]") +
         rigid_body("coupler", "1", "[1, 1, 1]", "[0.2, 0, 0.2]") +
         rigid_body("rocker", "1", "[1, 1, 1]", "[0.4, 0, 0.15]") + hinge("a", "ground", "crank", "[0, 0, 0]") +
         hinge("b", "crank", "coupler", "[0, 0, 0.1]") + hinge("d", "ground", "rocker", "[0.4, 0, 0]") +
         (fourth == "revolute" ? hinge("c", "coupler", "rocker", "[0.4, 0, 0.3]")
                               : joint("c", fourth, "coupler", "rocker", "[0.4, 0, 0.3]"));
}

// Four parallel hinges in space: 6*3 - 4*5 = -2 motions by counting, one by seeing: three equations follow from others.
TEST(JointRules, AllEquationsThatFollowFromOthersAreNamed)
{
  const std::string said = complaint(four_bar("revolute") + settings + "signals = { }\n");
  EXPECT_NE(said.find("3 equations are redundant"), std::string::npos) << said;
  EXPECT_NE(said.find("follows from the equations of \""), std::string::npos) << said;
  EXPECT_NE(said.find("a spherical joint instead of a revolute"), std::string::npos) << said;
  std::size_t lines = 0;
  for (std::size_t i = said.find("which constrains"); i != std::string::npos; i = said.find("which constrains", i + 1))
    ++lines;
  EXPECT_EQ(lines, 3u) << said;
  const std::string less = complaint(four_bar("spherical") + settings + "signals = { }\n"); // two rotations less
  EXPECT_NE(less.find("one equation is redundant"), std::string::npos) << less;
}

/// Crank and rod of 0.1 and 0.3 m, whose slider is pulled at constant speed to where they are stretched at 0.4 m.
TEST(JointRules, AFailureNearADeadPositionIsNamed)
{
  const auto motion =
      stopped(planar_body("crank", "1", "0.01", "[0, 0, '0.05 m']") +
              planar_body("rod", "1", "0.01", "['0.5*sqrt(0.08 m^2)', 0, '0.05 m']") +
              slider_body("slide", "1", "[1, 0, 0]", {{"position", "['sqrt(0.08 m^2)', 0, 0]"}}) +
              revolute("pivot", "ground", "crank", "[0, 0, 0]") + revolute("pin", "crank", "rod", "[0, 0, '0.1 m']") +
              revolute("wrist", "rod", "slide", "['sqrt(0.08 m^2)', 0, 0]") +
              joint("pull", "prescribed motion", {{"on", "slide.displacement"}, {"motion", "{ speed = '1 m/s' }"}}) +
              settings + "signals = { x = \"slide.displacement\" }\n");
  EXPECT_LT(motion.signal("x").final, 0.4 - std::sqrt(0.08) + 1e-3);
  EXPECT_NE(motion.result.failure.find("near a dead-centre position"), std::string::npos) << motion.result.failure;
}

// kappa = J W^2/(c + W^2 m) = 0.5*2500/(10 000 + 2500) = 0.1 at 50 rad/s, 0.0012 at 5 rad/s.
TEST(Rotor, OnACarrierThatTiltsGivesAWarningOfItsGyroscopicMoments)
{
  const auto warnings = [](const std::string &speed)
  {
    return coupling::texts_of(run(R"(
[frame]
mass = [[1, 0], [0, 1]]
stiffness = [[1e4, 0], [0, 1e4]]
[frame.interface.seat]
rows = { rx = 1, rz = 2 }
[body.wheel]
type = "rotor"
axis = [0, 1, 0]
on = "frame.seat"
inertia = 0.5
[start]
v = { wheel = ")" + speed + "\" }\n" +
                                  settings + "signals = { w = \"wheel.speed\" }\n")
                                  .result.findings);
  };
  const auto fast = warnings("50 rad/s");
  ASSERT_FALSE(fast.empty());
  EXPECT_NE(fast.back().find("the carrier of the rotor wheel tilts"), std::string::npos) << fast.back();
  EXPECT_NE(fast.back().find("10 %"), std::string::npos) << fast.back();
  for (const std::string &warning : warnings("5 rad/s"))
    EXPECT_EQ(warning.find("tilts"), std::string::npos) << warning;
}

// A carrier that rotates through large angles would carry a place beside its axis round, and turn the axis of a guide.
TEST(JointRules, WhatACarrierWouldCarryRoundIsRefused)
{
  const std::string arm   = planar_body("arm", "1", "1", "['0.5 m', 0, 0]");
  const auto        rotor = [&](const std::string &axis, const std::string &position) {
    return complaint(arm + rotor_body("s", "1", axis, {{"on", "arm"}, {"mass", "3"}, {"position", position}}));
  };
  EXPECT_NE(rotor("[0, 1, 0]", "[1, 0, 0]").find("\"arm\" rotates through large angles"), std::string::npos);
  EXPECT_NE(rotor("[0, 1, 0]", "[1, 0, 0]").find("revolute joint"), std::string::npos);
  EXPECT_NE(rotor("[1, 0, 0]", "[0.5, 0, 0]").find("its axis cannot follow"), std::string::npos);
  EXPECT_EQ(rotor("[0, 1, 0]", "[0.5, 0.2, 0]"), ""); // along its axis
  EXPECT_EQ(rotor("[0, 1, 0]", "[0, 0, 0]"), "");     // not given: on the carrier
  const std::string slider = arm + "[body.s]\ntype = \"slider\"\nmass = 3\nguide = \"arm\"\n";
  EXPECT_NE(complaint(slider + "axis = [1, 0, 0]\n").find("prismatic joint"), std::string::npos);
  EXPECT_EQ(complaint(slider + "axis = [0, 1, 0]\n"), "");
}

TEST(JointRules, AMassFarFromItsInterfaceGivesAWarning)
{
  const auto warnings = [](const std::string &rows, const std::string &position)
  {
    const apps::Scene scene =
        test::scene_of("[frame]\nmass = [[10]]\nstiffness = [[1000]]\n[frame.interface.a]\nrows = { " + rows +
                       " = 1 }\nposition = [0, 0, 0]\n" +
                       slider_body("r", "90", "[1, 0, 0]", {{"guide", "frame.a"}, {"position", position}}));
    return apps::carried_warnings(scene, apps::build_machine(scene).model());
  };
  ASSERT_EQ(warnings("ry", "[1, 0, 0]").size(), 1u);
  EXPECT_NE(warnings("ry", "[1, 0, 0]")[0].find("1 m from its own"), std::string::npos)
      << warnings("ry", "[1, 0, 0]")[0];
  EXPECT_TRUE(warnings("uz", "[1, 0, 0]").empty()); // the interface does not turn
  EXPECT_TRUE(warnings("ry", "[0, 1, 0]").empty()); // beside it along the axis it turns about
}

} // namespace
} // namespace gestell::tests
