// What cannot start is found by `gestell check`, in words that name what is to be changed.

#include "tests/support/scene_motion.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

/// What check_start() says against a text; "" if nothing.
std::string objection(const std::string &text)
{
  const apps::Scene scene = test::scene_of(text);
  apps::check_scene(scene);
  return refusal([&] { apps::check_start(scene); });
}

void expect_objection(const std::string &text, const std::vector<std::string> &words)
{
  const std::string said = objection(text);
  for (const std::string &part : words)
    EXPECT_NE(said.find(part), std::string::npos) << "said: " << said << "\nnot: " << part;
}

const std::string settings = steps("1 ms", "0.1 s") + signals("");

const std::string slide = slider_body("slide", "2 kg", "[1, 0, 0]", {{"position", "[1, 0, 0]"}});

std::string dry(const std::string &name)
{
  return element(name, "dry friction", {{"from", "slide"}, {"kinetic_force", "10"}, {"static_force", "12"}});
}

TEST(Starts, TwoThatStickOnOneMotionAreNamed)
{
  expect_objection(slide + dry("guide") + dry("seal") + settings,
                   {"element.seal: ", "\"seal\" sticks at the start and constrains the motion of slide",
                    "which \"guide\" also constrains", "give it the type \"friction\""});
  EXPECT_EQ(objection(slide + dry("guide") + settings), "");
  EXPECT_EQ(objection(slide + dry("guide") + dry("seal") + start("v = { slide = 1 }") + settings), "");
}

TEST(Starts, WhatSticksToWhatAJointHoldsIsNamed)
{
  expect_objection(slide + dry("guide") + joint("stay", "distance", {{"from", "ground"}, {"to", "slide"}}) + settings,
                   {"element.guide: ", "\"guide\" sticks at the start", "which \"stay\" also constrains"});
}

// The rest of a static start need not be sought for it.
TEST(Starts, JointsThatSayTheSameTwiceAreFoundBeforeAStaticInitialState)
{
  expect_objection("gravity = [0, 0, -9.81]\n" + planar_body("bar", "1", "0.1", "[0.5, 0, 0]") +
                       revolute("left", "ground", "bar", "[0, 0, 0]") +
                       revolute("right", "ground", "bar", "[1, 0, 0]") + start("rule = 'static'") + settings,
                   {"the joints are redundant", "\"right\" (fx)", "\"left\""});
}

// Friction at the lever h = 0.6 m makes the moment that causes it, k h = 2 mu/L h = 1.5 times.
TEST(Starts, AGuideThatJamsIsNamed)
{
  expect_objection(
      planar_body("carriage", "3 kg", "1 kg m^2", "[0, 0, 0]") +
          joint("rail", "prismatic", "ground", "carriage", "[0, 0, '-0.6 m']",
                {{"axis", "[1, 0, 0]"}, {"friction", "{ coefficient = 0.25, length = '0.2 m' }"}}) +
          element("moment", "force", {{"from", "carriage"}, {"about", "[0, 1, 0]"}, {"constant", "2 N m"}}) +
          start("v = { 'carriage.ux' = 1 }") + settings,
      {"joint.rail: ", "no initial state", "the force of \"rail\"", "jams: lengthen the guide"});
}

} // namespace
} // namespace gestell::tests
