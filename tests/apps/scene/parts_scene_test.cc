// [frame.part.NAME] and [frame.joint.NAME].

#include "apps/scene/build/build_machine.h"
#include "tests/support/refusal.h"
#include "tests/support/scene_parts.h"
#include "tests/support/test.h"

namespace gestell::test
{
namespace
{

using ::testing::HasSubstr;

/// Three bars in a row from files that are never opened, the third equal to the second; a spring on the last.
std::string bars(const std::string &joints, const std::string &more = "", const std::string &damping = "")
{
  return quoted(R"(name = "bars"
[frame]
)" + damping + R"(
[frame.part.base]
cad  = 'bar.geo'
mesh = { size = '0.1 m' }
[frame.part.base.surface.wall]
plane = { normal = [-1, 0, 0], through = [0, 0, 0] }
[frame.part.base.surface.end]
plane = { normal = [1, 0, 0], through = [2, 0, 0] }
[frame.part.base.support.wall]
surface = 'wall'
clamped = true
[frame.part.base.interface.end]
surface = 'end'
[frame.part.arm]
cad  = 'bar.geo'
mesh = { size = '0.1 m' }
placement = { origin = [2, 0, 0] }
[frame.part.arm.surface.rear]
plane = { normal = [-1, 0, 0], through = [0, 0, 0] }
[frame.part.arm.surface.end]
plane = { normal = [1, 0, 0], through = [2, 0, 0] }
[frame.part.arm.interface.rear]
surface = 'rear'
[frame.part.arm.interface.end]
surface = 'end'
position = [2, 0, 0]
[frame.part.tip]
same_as = 'arm'
placement = { origin = [4, 0, 0], axis = [0, 0, 1], angle = '90 deg', mirror = [1, 0, 0] }
)" + joints + more);
}

const std::string middle = "[frame.joint.middle]\nbetween = ['base.end', 'arm.rear']\n";
const std::string outer =
    "[frame.joint.outer]\ntype = 'contact'\nnormal = [1, 0, 0]\nbetween = ['arm.end', 'tip.rear']\n";

apps::Scene read(const std::string &text)
{
  const SceneFolder folder;
  folder.write("bar.geo", "");
  return apps::read_scene(folder.write("scene.toml", text));
}

std::string said(const std::string &text)
{
  return tests::refusal([&] { apps::check_scene(read(text)); });
}

TEST(PartsScene, ReadsPartsPlacesAndJoints)
{
  const auto  scene = read(bars(middle + outer));
  const auto &frame = scene.frame.parts;
  EXPECT_EQ(scene.frame.source, apps::FrameSource::parts);
  ASSERT_EQ(frame.parts.size(), 3u);
  EXPECT_EQ(frame.parts[2].geometry.interfaces.size(), 2u); // of the arm
  EXPECT_NEAR(frame.parts[2].placement.Q.determinant(), -1., 1e-15);
  EXPECT_LT((frame.parts[2].placement.Q * Eigen::Vector3d::UnitX() + Eigen::Vector3d::UnitY()).norm(), 1e-15);
  EXPECT_EQ(frame.joints[1].kind, coupling::JointKind::contact);
  EXPECT_EQ(coupling::kept_interfaces(frame), std::vector<std::string>{"tip.end"});
  const auto place = coupling::interfaces_in_frame(frame).at(0).position.value();
  EXPECT_NEAR(place[0], 4., 1e-15);
  EXPECT_NEAR(place[1], -2., 1e-15);
}

TEST(PartsScene, SignalsTellInterfacesSupportsAndJoints)
{
  const std::string signals = "[output.signals]\nu = 'frame.tip.end.uz'\nF = 'frame.base.support.wall.z'\n"
                              "N = 'frame.joint.outer.normal_force'\nM = 'frame.joint.middle.my'\n";
  EXPECT_EQ(said(bars(middle + outer, signals)), "");
  EXPECT_THAT(said(bars(middle + outer, "[output.signals]\nu = 'frame.arm.end.uz'\n")),
              HasSubstr("there is no \"frame.arm.end.uz\""));
  const std::string keep = "keep = true\n";
  EXPECT_EQ(said(bars(middle + outer + keep, "[output.signals]\nu = 'frame.arm.end.uz'\n")), "");
}

TEST(PartsScene, RefusesWhatDoesNotFit)
{
  const std::vector<std::array<std::string, 2>> refused = {
      {"", "frame.part.arm: no joint connects this part with 'base'"},
      {middle + "[frame.joint.outer]\nbetween = ['arm.end', 'tpi.rear']\n",
       "there is no part 'tpi'; did you mean 'tip'?"},
      {middle + "[frame.joint.outer]\nbetween = ['arm.end', 'tip.raer']\n", "part 'tip' has no interface 'raer'"},
      {middle + "[frame.joint.outer]\nbetween = ['arm.end']\n", "needs two interfaces"},
      {middle + "[frame.joint.outer]\nbetween = ['arm.end', 'tip']\n", "got 'tip'; needs PART.INTERFACE"},
      {middle + outer + "[frame.joint.more]\nbetween = ['arm.end', 'tip.end']\n", "interface 'arm.end' is joined by 'outer'; divide"},
      {middle + outer + "[frame.joint.more]\nbetween = ['tip.end', 'tip.end']\n", "joins part 'tip' with itself"},
      {middle + outer + "prestress = '5 kN'\n", "prestress: applies to type = \"tie rod\""},
      {middle + outer + "stiffness = 5\n", "stiffness: applies to type = \"bolts\""},
      {middle + "[frame.joint.outer]\ntype = 'contact'\nbetween = ['arm.end', 'tip.rear']\n", "needs 'normal'"},
      {middle + "[frame.joint.outer]\ntype = 'bolts'\nbetween = ['arm.end', 'tip.rear']\n", "needs a 'stiffness'"},
      {middle + "[frame.joint.outer]\ntype = 'tie rod'\nbetween = ['arm.end', 'tip.rear']\n", "diameter"},
      {middle + outer + "[frame.part.more]\nsame_as = 'arms'\n", "there is no part 'arms' with its own geometry"},
      {middle + outer + "[frame.part.more]\nsame_as = 'arm'\nmaterial = 'steel'\n", "is taken from the part 'arm'; with 'same_as' only"},
      {middle + outer + "[reduction]\nmethod = 'none'\n", "parts are joined after their reduction"},
      {middle + outer + "[reduction]\ninside = 'free-interface'\n", "does not retain the joined interfaces"}};
  for (const auto &[joints, words] : refused)
    EXPECT_THAT(said(bars(joints)), HasSubstr(words)) << joints;
  EXPECT_THAT(said(bars(middle + outer, "", "cad = 'bar.geo'\n")), HasSubstr("needs exactly one of"));
  EXPECT_THAT(
      said(bars(middle + outer, "",
                "damping = { rayleigh = [{ frequency = 20, ratio = 0.01 }, { frequency = 90, ratio = 0.02 }] }\n")),
      HasSubstr("set it for the parts"));
  std::string cut = bars(middle + outer, "", "prestress = { tie_rods = true }\n");
  EXPECT_EQ(said(cut), "");
  cut.insert(cut.find("placement = { origin = [2, 0, 0] }"), "parts = 2\n");
  EXPECT_THAT(said(cut), HasSubstr("needs each part in one piece; remove 'parts' of frame.part.arm"));
}

} // namespace
} // namespace gestell::test
