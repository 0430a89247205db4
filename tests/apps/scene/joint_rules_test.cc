// Rules of joints, carriers and switches, each on the smallest machine that shows it.

#include "tests/support/scene_motion.h"

#include "apps/scene/build/carried_bodies.h"

#include <gtest/gtest.h>

namespace gestell::tests
{
namespace
{

using test::complaint;

const std::string settings = "[run]\nmethod = \"bdf\"\nstep = \"1 ms\"\nend = \"1 s\"\n[output]\npicture_step = 0\n";

/// A slide that a driven rod pushes along x.
const std::string driven_slide = R"(
[body.slide]
type = "slider"
axis = [1, 0, 0]
mass = "2 kg"
position = ["1 m", 0, 0]
[joint.rod]
type = "distance"
from = "ground"
to = "slide"
motion = { speed = "0.5 m/s", brake = { duration = "0.2 s" } }
)";

// The body's own point is where it is described; a switch may have the name of what it tells.
TEST(JointRules, ASwitchBrakesTheJointWhoseNameItHas)
{
  const auto motion = run(driven_slide +
                          "[switch.rod]\nwhen = \"slide.displacement\"\nabove = \"0.1 m\"\ntell = \"rod\"\n"
                          "order = \"brake\"\n" +
                          settings + "signals = { x = \"slide.displacement\", F = \"rod.force\" }\n");
  EXPECT_EQ(motion.result.failure, "");
  EXPECT_NEAR(time_of(motion, "switch"), 0.2, 1e-9);
  EXPECT_NEAR(time_of(motion, "braking_ends"), 0.4, 1e-9);
  EXPECT_NEAR(motion.signal("x").final, 0.1 + 0.5 * 0.5 * 0.2, 1e-9);
  EXPECT_NEAR(motion.signal("F").min, -2. * 0.5 / 0.2, 1e-6); // m a while it brakes
}

// A length moves from the begin of the run on, whenever that is.
TEST(JointRules, APrescribedLengthBeginsWithTheRun)
{
  const auto motion = run(driven_slide + "[run]\nmethod = \"bdf\"\nstep = \"1 ms\"\nbegin = \"10 s\"\nend = \"11 s\"\n"
                                         "[output]\npicture_step = 0\nsignals = { x = \"slide.displacement\" }\n");
  EXPECT_EQ(motion.result.failure, "");
  EXPECT_NEAR(motion.signal("x").final, 0.5, 1e-9);
}

// A cross slide carries both motions into its joints: the ends of a rod of 5 m stay on a quarter circle.
TEST(JointRules, ACrossSlideCarriesBothItsMotions)
{
  const std::string cross  = R"(
[body.x]
type = "slider"
axis = [1, 0, 0]
mass = "1 kg"
position = ["3 m", 0, 0]
[body.z]
type = "slider"
axis = [0, 0, 1]
guide = "x"
mass = "1 kg"
position = ["3 m", 0, "4 m"]
[joint.rod]
type = "distance"
from = "ground"
to = "z"
[start]
v = { z = "-1 m/s" }
)";
  const auto        motion = run(cross + settings + "signals = { x = \"x.displacement\", z = \"z.displacement\" }\n");
  EXPECT_EQ(motion.result.failure, "");
  const double x = 3. + motion.signal("x").final, z = 4. + motion.signal("z").final;
  EXPECT_NEAR(std::hypot(x, z), 5., 1e-9);
  EXPECT_GT(x, 3.5);
}

// A point has no rotation: welded to a body it rides along and does not hold its angle.
TEST(JointRules, APointWeldedToABodyLeavesItFreeToTurn)
{
  const std::string swing = R"(
gravity = [0, 0, -9.81]
[body.bar]
type = "planar"
normal = [0, 1, 0]
mass = "1 kg"
inertia = "0.1 kg m^2"
position = ["0.5 m", 0, 0]
[body.bob]
type = "point"
mass = "1 kg"
position = ["1 m", 0, 0]
[joint.hinge]
type = "revolute"
from = "ground"
to = "bar"
at = [0, 0, 0]
[joint.weld]
type = "rigid"
from = "bar"
to = "bob"
at = ["1 m", 0, 0]
)";
  const auto        motion =
      run(swing + settings + "signals = { phi = \"bar.angle\", x = \"bob.x\", y = \"bob.y\", z = \"bob.z\" }\n");
  EXPECT_EQ(motion.result.failure, "");
  EXPECT_GT(motion.signal("phi").max, 1.);
  EXPECT_NEAR(std::hypot(motion.signal("x").final, motion.signal("z").final), 1., 1e-9);
  EXPECT_NEAR(motion.signal("y").final, 0., 1e-12);
}

TEST(JointRules, WhatCannotBeFollowedIsRefused)
{
  const std::string arm = R"(
[body.arm]
type = "planar"
normal = [0, 1, 0]
mass = 1
inertia = 1
position = [0, 0, 0]
)";
  EXPECT_NE(complaint(arm + "[element.lump]\ntype = \"point mass\"\non = \"arm\"\nmass = 1\noffset = [1, 0, 0]\n")
                .find("would turn with it"),
            std::string::npos);
  try
  {
    run(driven_slide + "[start]\nrule = \"steady\"\n" + settings);
    FAIL() << "accepted";
  }
  catch (const std::invalid_argument &e)
  {
    EXPECT_NE(std::string(e.what()).find("do not close joints"), std::string::npos) << e.what();
  }
}

/// A four-bar linkage of bodies in space: cranks of 0.1 and 0.3 m on the ground, a coupler between them.
std::string four_bar(const std::string &fourth)
{
  std::string scene;
  for (const std::string at : {"crank [0, 0, 0.05]", "coupler [0.2, 0, 0.2]", "rocker [0.4, 0, 0.15]"})
    scene += "[body." + at.substr(0, at.find(' ')) +
             "]\ntype = \"rigid\"\nmass = 1\ninertia = [1, 1, 1]\nposition = " + at.substr(at.find(' ') + 1) + "\n";
  const auto joint = [&](const std::string &name, const std::string &from, const std::string &to, const std::string &at,
                         const std::string &type)
  {
    scene += "[joint." + name + "]\ntype = \"" + type + "\"\nfrom = \"" + from + "\"\nto = \"" + to + "\"\nat = " + at +
             "\n" + (type == "spherical" ? "" : "axis = [0, 1, 0]\n");
  };
  joint("a", "ground", "crank", "[0, 0, 0]", "revolute");
  joint("b", "crank", "coupler", "[0, 0, 0.1]", "revolute");
  joint("c", "coupler", "rocker", "[0.4, 0, 0.3]", fourth);
  joint("d", "ground", "rocker", "[0.4, 0, 0]", "revolute");
  return scene;
}

// Four parallel hinges in space: 6*3 - 4*5 = -2 motions by counting, one by seeing: three equations follow from others.
TEST(JointRules, AllEquationsThatFollowFromOthersAreNamed)
{
  const std::string said = complaint(four_bar("revolute") + settings + "signals = { }\n");
  EXPECT_NE(said.find("3 equations are too many"), std::string::npos) << said;
  EXPECT_NE(said.find("follows from the equations of \""), std::string::npos) << said;
  EXPECT_NE(said.find("a spherical joint in place of a revolute"), std::string::npos) << said;
  std::size_t lines = 0;
  for (std::size_t i = said.find("which holds"); i != std::string::npos; i = said.find("which holds", i + 1))
    ++lines;
  EXPECT_EQ(lines, 3u) << said;
  const std::string less = complaint(four_bar("spherical") + settings + "signals = { }\n"); // two rotations less
  EXPECT_NE(less.find("one equation is too much"), std::string::npos) << less;
}

/// Crank and rod of 0.1 and 0.3 m, whose slider is pulled at constant speed to where they are stretched at 0.4 m.
TEST(JointRules, AFailureNearADeadPositionIsNamed)
{
  const auto motion = run(R"toml(
[body.crank]
type = "planar"
normal = [0, 1, 0]
mass = 1
inertia = 0.01
position = [0, 0, "0.05 m"]
[body.rod]
type = "planar"
normal = [0, 1, 0]
mass = 1
inertia = 0.01
position = ["0.5*sqrt(0.08 m^2)", 0, "0.05 m"]
[body.slide]
type = "slider"
axis = [1, 0, 0]
mass = 1
position = ["sqrt(0.08 m^2)", 0, 0]
[joint.pivot]
type = "revolute"
from = "ground"
to = "crank"
at = [0, 0, 0]
[joint.pin]
type = "revolute"
from = "crank"
to = "rod"
at = [0, 0, "0.1 m"]
[joint.wrist]
type = "revolute"
from = "rod"
to = "slide"
at = ["sqrt(0.08 m^2)", 0, 0]
[joint.pull]
type = "prescribed motion"
on = "slide.displacement"
motion = { speed = "1 m/s" }
)toml" + settings + "signals = { x = \"slide.displacement\" }\n");
  EXPECT_LT(motion.signal("x").final, 0.4 - std::sqrt(0.08) + 1e-3);
  EXPECT_NE(motion.result.failure.find("near a dead position"), std::string::npos) << motion.result.failure;
}

// kappa = J W^2/(c + W^2 m) = 0.5*2500/(10 000 + 2500) = 0.1 at 50 rad/s, 0.0012 at 5 rad/s.
TEST(Rotor, OnACarrierThatTiltsIsWarnedOfItsGyroscopicMoments)
{
  const auto warnings = [](const std::string &speed)
  {
    return run(R"(
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
v = { wheel = ")" +
               speed + "\" }\n" + settings + "signals = { w = \"wheel.speed\" }\n")
        .result.warnings;
  };
  const auto fast = warnings("50 rad/s");
  ASSERT_FALSE(fast.empty());
  EXPECT_NE(fast.back().find("the rotor wheel is carried by what tilts"), std::string::npos) << fast.back();
  EXPECT_NE(fast.back().find("10 %"), std::string::npos) << fast.back();
  for (const std::string &warning : warnings("5 rad/s"))
    EXPECT_EQ(warning.find("tilts"), std::string::npos) << warning;
}

// A carrier that turns by any angle would carry a place beside its axis round, and turn the axis of a guide.
TEST(JointRules, WhatACarrierWouldCarryRoundIsRefused)
{
  const std::string arm   = "[body.arm]\ntype = \"planar\"\nnormal = [0, 1, 0]\nmass = 1\ninertia = 1\n"
                            "position = [\"0.5 m\", 0, 0]\n";
  const auto        rotor = [&](const std::string &axis, const std::string &position)
  {
    return complaint(arm + "[body.s]\ntype = \"rotor\"\naxis = " + axis +
                     "\non = \"arm\"\ninertia = 1\nmass = 3\nposition = " + position + "\n");
  };
  EXPECT_NE(rotor("[0, 1, 0]", "[1, 0, 0]").find("\"arm\" turns by any angle"), std::string::npos);
  EXPECT_NE(rotor("[0, 1, 0]", "[1, 0, 0]").find("revolute joint"), std::string::npos);
  EXPECT_NE(rotor("[1, 0, 0]", "[0.5, 0, 0]").find("its axis would not follow"), std::string::npos);
  EXPECT_EQ(rotor("[0, 1, 0]", "[0.5, 0.2, 0]"), ""); // along its axis
  EXPECT_EQ(rotor("[0, 1, 0]", "[0, 0, 0]"), "");     // not given: on the carrier
  const std::string slider = arm + "[body.s]\ntype = \"slider\"\nmass = 3\nguide = \"arm\"\n";
  EXPECT_NE(complaint(slider + "axis = [1, 0, 0]\n").find("prismatic joint"), std::string::npos);
  EXPECT_EQ(complaint(slider + "axis = [0, 1, 0]\n"), "");
}

TEST(JointRules, AMassFarFromItsInterfaceIsWarnedOf)
{
  const auto warnings = [](const std::string &rows, const std::string &position)
  {
    const test::SceneFolder folder;
    const apps::Scene       scene = apps::read_scene(folder.write(
              "scene.toml", "[frame]\nmass = [[10]]\nstiffness = [[1000]]\n[frame.interface.a]\nrows = { " + rows +
                                " = 1 }\nposition = [0, 0, 0]\n[body.r]\ntype = \"slider\"\naxis = [1, 0, 0]\n"
                                      "guide = \"frame.a\"\nmass = 90\nposition = " +
                                position + "\n"));
    return apps::carried_warnings(scene, apps::build_machine(scene).model());
  };
  ASSERT_EQ(warnings("ry", "[1, 0, 0]").size(), 1u);
  EXPECT_NE(warnings("ry", "[1, 0, 0]")[0].find("1 m beside"), std::string::npos) << warnings("ry", "[1, 0, 0]")[0];
  EXPECT_TRUE(warnings("uz", "[1, 0, 0]").empty()); // the interface does not turn
  EXPECT_TRUE(warnings("ry", "[0, 1, 0]").empty()); // beside it along the axis it turns about
}

} // namespace
} // namespace gestell::tests
