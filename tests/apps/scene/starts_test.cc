// What cannot start is found by `gestell check`, in words that name what is to be changed.

#include "tests/support/scene_motion.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace gestell::tests
{
namespace
{

/// What check_start() says against a text; "" if nothing.
std::string objection(const std::string &text)
{
  const test::SceneFolder folder;
  const apps::Scene       scene = apps::read_scene(folder.write("scene.toml", text));
  apps::check_scene(scene);
  try
  {
    apps::check_start(scene);
  }
  catch (const std::invalid_argument &error)
  {
    return error.what();
  }
  return "";
}

void expect_objection(const std::string &text, const std::vector<std::string> &words)
{
  const std::string said = objection(text);
  for (const std::string &part : words)
    EXPECT_NE(said.find(part), std::string::npos) << "said: " << said << "\nnot: " << part;
}

const std::string settings = "[run]\nstep = \"1 ms\"\nend = \"0.1 s\"\n[output]\npicture_step = 0\nsignals = { }\n";

const std::string slide = "[body.slide]\ntype = \"slider\"\naxis = [1, 0, 0]\nmass = \"2 kg\"\nposition = [1, 0, 0]\n";

std::string dry(const std::string &name)
{
  return "[element." + name + "]\ntype = \"dry friction\"\nfrom = \"slide\"\nkinetic_force = 10\nstatic_force = 12\n";
}

TEST(Starts, TwoThatStickOnOneMotionAreNamed)
{
  expect_objection(slide + dry("guide") + dry("seal") + settings,
                   {"element.seal: ", "\"seal\" sticks at the start and holds the motion of slide",
                    "which \"guide\" holds too", "give it the type \"friction\""});
  EXPECT_EQ(objection(slide + dry("guide") + settings), "");
  EXPECT_EQ(objection(slide + dry("guide") + dry("seal") + "[start]\nv = { slide = 1 }\n" + settings), "");
}

TEST(Starts, WhatSticksToWhatAJointHoldsIsNamed)
{
  expect_objection(slide + dry("guide") + "[joint.stay]\ntype = \"distance\"\nfrom = \"ground\"\nto = \"slide\"\n" +
                       settings,
                   {"element.guide: ", "\"guide\" sticks at the start", "which \"stay\" holds too"});
}

// The rest of a static start need not be sought for it.
TEST(Starts, JointsThatSayTheSameTwiceAreFoundBeforeAStaticStart)
{
  expect_objection(
      "gravity = [0, 0, -9.81]\n[body.bar]\ntype = \"planar\"\nnormal = [0, 1, 0]\nmass = 1\ninertia = 0.1\n"
      "position = [0.5, 0, 0]\n[joint.left]\ntype = \"revolute\"\nfrom = \"ground\"\nto = \"bar\"\n"
      "at = [0, 0, 0]\n[joint.right]\ntype = \"revolute\"\nfrom = \"ground\"\nto = \"bar\"\nat = [1, 0, 0]\n"
      "[start]\nrule = \"static\"\n" +
          settings,
      {"say the same twice", "\"right\" (fx)", "\"left\""});
}

// Friction at the lever h = 0.6 m makes the moment that causes it, k h = 2 mu/L h = 1.5 times.
TEST(Starts, AGuideThatJamsIsNamed)
{
  expect_objection(R"toml(
[body.carriage]
type = "planar"
normal = [0, 1, 0]
mass = "3 kg"
inertia = "1 kg m^2"
position = [0, 0, 0]
[joint.rail]
type = "prismatic"
from = "ground"
to = "carriage"
at = [0, 0, "-0.6 m"]
axis = [1, 0, 0]
friction = { coefficient = 0.25, length = "0.2 m" }
[element.moment]
type = "force"
from = "carriage"
about = [0, 1, 0]
constant = "2 N m"
[start]
v = { "carriage.ux" = 1 }
)toml" + settings,
                   {"joint.rail: ", "the machine does not start", "the force of \"rail\"", "jams: lengthen the guide"});
}

} // namespace
} // namespace gestell::tests
