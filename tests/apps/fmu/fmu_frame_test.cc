// FMUs of machines with joints, switches and a frame of finite elements: their motion is that of a run.

#include "tests/apps/fmu/exported_fmu.h"
#include "tests/support/test.h"

namespace gestell::tests
{

TEST(FmuOfJointedMachine, MovesAsARunThroughItsEvents)
{
  const Folder      folder("fmu_crane");
  const std::string crane = scene("crane_minimal.toml") + " --set run.end='\"6 s\"' --set output.step='\"10 ms\"'";
  ASSERT_EQ(gestell("run " + crane + folder.option()).exit_code, 0);
  const Exported fmu(folder, "crane", crane);
  // A table has ten digits of positions of some 10 m that move by some cm.
  EXPECT_LT(difference_from_run(*fmu.fmu, folder.results() / "history.csv"), 1e-7);
}

TEST(FmuOfReducedFrame, CarriesItsFrameAlong)
{
  const Folder      folder("fmu_press");
  const std::string press =
      scene("press.toml") + " --set run.end='\"0.3 s\"' --set output.step='\"1 ms\"' --set output.picture_step=0";
  const Answer run = gestell("run " + press + folder.option());
  ASSERT_EQ(run.exit_code, 0) << run.text;
  const Exported fmu(folder, "press", press, "--inputs frame.crown.uy");
  EXPECT_TRUE(std::filesystem::exists(fmu.fmu->folder() / "resources" / "frame.h5"));
  EXPECT_THAT(fmu.fmu->named("parameter"), testing::Contains("s_cl"));
  EXPECT_THAT(fmu.fmu->named("parameter"), testing::Not(testing::Contains("c_F"))); // the frame was reduced with it
  EXPECT_LT(difference_from_run(*fmu.fmu, folder.results() / "history.csv"), 1e-7);
}

} // namespace gestell::tests
