// Rules of joints, carriers and switches, each on the smallest machine that shows it.

#include "scene_motion.h"

#include "apps/scene/carried_bodies.h"

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
    EXPECT_NE(std::string(e.what()).find("does not close ideal joints"), std::string::npos) << e.what();
  }
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
    return apps::carried_warnings(scene, apps::build_machine(scene));
  };
  ASSERT_EQ(warnings("ry", "[1, 0, 0]").size(), 1u);
  EXPECT_NE(warnings("ry", "[1, 0, 0]")[0].find("1 m beside"), std::string::npos) << warnings("ry", "[1, 0, 0]")[0];
  EXPECT_TRUE(warnings("uz", "[1, 0, 0]").empty()); // the interface does not turn
  EXPECT_TRUE(warnings("ry", "[0, 1, 0]").empty()); // beside it along the axis it turns about
}

} // namespace
} // namespace gestell::tests
