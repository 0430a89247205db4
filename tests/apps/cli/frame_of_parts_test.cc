// Frames of parts, by the program: the tie rod press.

#include "tests/support/program.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

/// Meshes of half the cost.
const std::string coarse = " --set frame.part.crown.mesh.size='\"0.2 m\"' --set frame.part.bed.mesh.size='\"0.2 m\"'"
                           " --set frame.part.'\"left column\"'.mesh.size='\"0.2 m\"'";

TEST(TieRodPress, KeepsItsJointsClosedThroughTheCut)
{
  const Folder folder("tie_rod_press");
  const Answer run = gestell("run " + scene("tie_rod_press.toml") + coarse + folder.option());
  expect_answer(run, 0, {"N_ul"});
  EXPECT_FALSE(run.says("opens")) << run.text;
  const std::string summary = read(folder.results() / "summary.json");
  // the cut pulls with 1024 kN at crown and bed: half of it at each rod, shared with the column
  EXPECT_NEAR(json_number(summary, {"F_P", "max"}), 1.05e6, 0.03e6);
  EXPECT_NEAR(json_number(summary, {"rod_l", "max"}), 0.929e6, 0.01e6);
  EXPECT_GT(json_number(summary, {"N_ul", "min"}), 0.35e6);

  const Answer loose =
      gestell("run " + scene("tie_rod_press.toml") + coarse + folder.option() + " --set parameters.F_0='\"300 kN\"'");
  expect_answer(loose, 0, {"frame.joint.\"upper left\": this joint opens: its normal force drops to -156"});
}

TEST(TieRodPress, IsMadeOfThreeReductionsThatAChangeOfTheRodsKeeps)
{
  const Folder folder("tie_rod_press_cache");
  const auto   call = [&](const std::string &arguments)
  {
    return shell("GESTELL_CACHE='" + (folder / "cache").string() + "' '" GESTELL_BINARY_DIR "/bin/gestell' " +
                 arguments);
  };
  const auto list = [&] { return count(call("reduce --list").text, ".geo"); };
  expect_answer(call("reduce " + scene("tie_rod_press.toml") + coarse), 0, {"reduced frame created"});
  EXPECT_EQ(list(), 3); // crown, column, bed
  expect_answer(call("reduce " + scene("tie_rod_press.toml") + coarse), 0, {"reduced frame from the cache"});
  const Answer other = call("reduce " + scene("tie_rod_press.toml") + coarse + " --set parameters.F_0='\"700 kN\"'");
  expect_answer(other, 0, {"reduced frame created"});
  EXPECT_TRUE(other.says("clamping force 69") || other.says("clamping force 700 kN")) << other.text; // by the mesh
  EXPECT_EQ(list(), 3);
}

} // namespace
} // namespace gestell::tests
