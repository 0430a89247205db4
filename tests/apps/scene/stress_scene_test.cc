// [output.stress] of scenes.

#include "apps/scene/scene.h"
#include "tests/support/refusal.h"
#include "tests/support/scene_parts.h"
#include "tests/support/test.h"

namespace gestell::test
{
namespace
{

using apps::StressInstant;

/// A frame from a CAD file that is never opened, with two signals.
std::string scene_with(const std::string &stress, const std::string &more = "")
{
  return R"(name = "beam"
[frame]
cad  = "beam.geo"
mesh = { size = "0.1 m" }
[frame.surface.wall]
plane = { normal = [-1, 0, 0], through = [0, 0, 0] }
[frame.surface.end]
plane = { normal = [1, 0, 0], through = [2, 0, 0] }
[frame.support.wall]
surface = "wall"
clamped = true
[frame.interface.tip]
surface = "end"
)" + tests::steps("1 ms", "2 s") +
         "[output.signals]\nu = 'frame.tip.uz'\nphi = 'frame.tip.ry'\n" + stress + more;
}

apps::Scene scene_of(const std::string &text)
{
  const SceneFolder folder;
  folder.write("beam.geo", "");
  return apps::read_scene(folder.write("scene.toml", text));
}

/// What is said against a scene.
std::string message(const std::string &text)
{
  return tests::refusal([&] { scene_of(text); });
}

TEST(StressScene, AsksTheFrameAndTheRunForWhatItNeeds)
{
  const apps::Scene scene = scene_of(scene_with(R"([output.stress]
at       = ["1.5 s", "0.5 s"]
largest  = ["u", "stress"]
smallest = "phi"
)"));
  EXPECT_TRUE(scene.frame.geometry.stress);
  const auto &states = scene.run.options.states;
  EXPECT_EQ(states.at, (std::vector<double>{0.5, 1.5})) << "in the order of time";
  ASSERT_EQ(states.extremes.size(), 2u);
  EXPECT_EQ(states.extremes[0].signal, 0);
  EXPECT_TRUE(states.extremes[0].largest);
  EXPECT_EQ(states.extremes[1].signal, 1);
  EXPECT_FALSE(states.extremes[1].largest);
  EXPECT_DOUBLE_EQ(states.step, 1e-3) << "that of the history";
  ASSERT_EQ(scene.stress.instants.size(), 5u);
  EXPECT_EQ(scene.stress.instants[2].label, "largest u");
  EXPECT_EQ(scene.stress.instants[3].when, StressInstant::largest_stress);
  EXPECT_EQ(scene.stress.instants[4].label, "smallest phi");
}

TEST(StressScene, MeansTheLargestStressIfNothingElseIsSaid)
{
  const apps::Scene scene = scene_of(scene_with("[output.stress]\n"));
  ASSERT_EQ(scene.stress.instants.size(), 1u);
  EXPECT_EQ(scene.stress.instants[0].when, StressInstant::largest_stress);
  EXPECT_DOUBLE_EQ(scene_of(scene_with("[output.stress]\nstep = \"4 ms\"\n")).run.options.states.step, 4e-3);
}

TEST(StressScene, CostsNothingWhereItIsNotWanted)
{
  const apps::Scene without = scene_of(scene_with(""));
  EXPECT_FALSE(without.frame.geometry.stress);
  EXPECT_TRUE(without.run.options.states.empty());
  const apps::Scene at = scene_of(scene_with("[output.stress]\nat = \"1 s\"\n"));
  EXPECT_EQ(at.run.options.states.step, 0.) << "nothing is looked for";
}

TEST(StressScene, RefusesWhatCannotBeReported)
{
  const auto says = [](const std::string &text, const std::string &part)
  {
    const std::string found = message(text);
    EXPECT_NE(found.find(part), std::string::npos) << found;
    EXPECT_NE(found.find("output.stress"), std::string::npos) << "the place: " << found;
  };
  says(scene_with("[output.stress]\nat = [\"3 s\"]\n"), "outside the run");
  says(scene_with("[output.stress]\nat = [\"3 mm\"]\n"), "time");
  says(scene_with("[output.stress]\nlargest = [\"ph\"]\n"), "did you mean 'phi'");
  says(scene_with("stress = \"frame.tip.ux\"\n[output.stress]\nlargest = \"stress\"\n"), "rename the signal");
  says(scene_with("[output.stress]\nsmallest = \"stress\"\n"), "no signal 'stress'");
  says(scene_with("[output.stress]\nstep = 0\n"), "step");
  says(scene_with("[output.stress]\nwhen = 1\n"), "when");
  says(scene_with("[output.stress]\n", "[reduction]\nmethod = \"none\"\n"), "reduced frame");
  says(small_scene() + "\n[output.stress]\n", "given by matrices");
}

} // namespace
} // namespace gestell::test
