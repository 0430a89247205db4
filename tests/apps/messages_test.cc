// What a scene may say in more than one way, and where a message points to.

#include "scene_motion.h"

#include <gtest/gtest.h>

namespace gestell::tests
{
namespace
{

using test::complaint;

TEST(Messages, TellAFormulaWhereAValueIsNeeded)
{
  const std::string brake = "[element.drive]\ntype = \"speed drive\"\non = \"shaft\"\nproportional_gain = 1\n"
                            "speed = 1\ninitial_speed = \"10 rad/s*sin(2*pi*1 Hz*t)\"\n";
  expect_complaint(rotor(2., "1 s") + brake, "It would be a formula of the time t, but this key takes a value");
  // a wrong unit alone is no formula
  EXPECT_EQ(complaint(rotor(2., "1 s") + "[element.f]\ntype = \"friction\"\nfrom = \"shaft\"\nforce = \"2 t\"\n")
                .find("formula"),
            std::string::npos);
}

const std::string two_slides = "[body.a]\ntype = \"slider\"\naxis = [1, 0, 0]\nmass = 1\n"
                               "[body.b]\ntype = \"slider\"\naxis = [1, 0, 0]\nmass = 1\n"
                               "[body.w]\ntype = \"rotor\"\naxis = [0, 0, 1]\ninertia = 1\n";

std::string sum(const std::string &terms)
{
  return two_slides + "[measure.s]\ntype = \"sum\"\nterms = " + terms +
         "\n[start]\nq = { a = 3, b = 5, w = 2 }\n[run]\nstep = \"1 ms\"\nend = \"2 ms\"\n[output.signals]\n"
         "s = \"s.value\"\n";
}

// A plain factor is a number where that fits, and else in SI: the radius of a pinion in m.
TEST(Messages, PlainFactorsOfASumFit)
{
  EXPECT_NEAR(run(sum("[{ of = \"b\" }, { of = \"a\", factor = 2 }]")).signal("s").final, 11., 1e-12);
  EXPECT_NEAR(run(sum("[{ of = \"w\", factor = -0.5 }, { of = \"a\" }]")).signal("s").final, 2., 1e-12);
  EXPECT_EQ(run(sum("[{ of = \"w\", factor = -0.5 }, { of = \"a\" }]")).signal("s").unit, "m");
  EXPECT_NEAR(run(sum("[{ of = \"a\", factor = 2 }, { of = \"b\", factor = -1 }]")).signal("s").final, 1., 1e-12);
  expect_complaint(sum("[{ of = \"a\", factor = 2 }, { of = \"w\", factor = -1 }]"),
                   "give one of the factors its unit");
  expect_complaint(sum("[{ of = \"a\" }, { of = \"w\", factor = \"2 kg\" }]"), "all terms must be lengths");
}

const std::string pendulum = "[body.p]\ntype = \"planar\"\nnormal = [0, 0, 1]\nmass = 1\ninertia = 1\n"
                             "position = [1, 0, 0]\n[run]\nstep = \"1 ms\"\nend = \"2 ms\"\n"
                             "[joint.hinge]\ntype = \"revolute\"\nfrom = \"ground\"\nto = \"p\"\nat = [0, 0, 0]\n";

TEST(Messages, APlanarHingeMayGiveTheAxisItHas)
{
  EXPECT_EQ(complaint(pendulum + "axis = [0, 0, -2]\n"), "");
  expect_complaint(pendulum + "axis = [0, 1, 0]\n", "joint.hinge.axis: 'p' turns about another axis only");
}

// The joint stands in line 10 of the scene.
TEST(Messages, PointToTheJointThatStaysOpen)
{
  expect_complaint(pendulum + "[start]\nq = { \"p.ux\" = 5, \"p.uy\" = 0 }\n", "scene.toml:10: joint.hinge: ");
}

TEST(Messages, ARunNeedsNoSignals)
{
  const auto motion = run(pendulum);
  EXPECT_EQ(motion.result.failure, "");
  EXPECT_EQ(motion.result.signals.size(), 0u);
}

} // namespace
} // namespace gestell::tests
