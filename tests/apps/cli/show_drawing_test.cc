// Pictures and films of a result, drawn by VTK on Xvfb.

#include "tests/support/program.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

/// Width and height of a PNG, which stand behind its head.
std::pair<int, int> size_of_png(const std::filesystem::path &file)
{
  const std::string bytes  = read(file);
  const auto        number = [&](std::size_t at)
  {
    int n = 0;
    for (std::size_t i = at; i < at + 4 && i < bytes.size(); ++i)
      n = 256 * n + static_cast<unsigned char>(bytes[i]);
    return n;
  };
  return {number(16), number(20)};
}

TEST(Show, DrawsPeakMotionAndModesAndLeavesNoServerBehind)
{
  if (shell("command -v Xvfb").exit_code != 0)
    GTEST_SKIP() << "Xvfb is not installed (package xvfb)";
  if (!std::filesystem::exists(GESTELL_BINARY_DIR "/bin/libgestell_show.so"))
    GTEST_SKIP() << "built without VTK's rendering";
  const Folder folder("show");
  expect_answer(gestell("run " + scene("press_minimal.toml") + " --set output.picture_step='\"20 ms\"'" +
                        " --set run.end='\"0.1 s\"'" + folder.option()),
                0, {});
  expect_answer(gestell("modes " + scene("press_minimal.toml") + folder.option()), 0,
                {"contains a run, which is kept"});
  const auto pictures = folder / "pictures";
  expect_answer(
      gestell("show '" + folder.results().string() + "' --quiet --width 400 --modes 1 -o '" + pictures.string() + "'"),
      0, {"machine.png", "machine_peak.png", "motion.ogv", "mode_1.png", "mode_1.ogv"});
  EXPECT_EQ(size_of_png(pictures / "machine_peak.png"), std::pair(400, 320));
  EXPECT_EQ(read(pictures / "mode_1.ogv").substr(0, 4), "OggS");
  EXPECT_EQ(count(read(pictures / "mode_1.apng"), "fcTL"), 24); // a control for each picture of a cycle
  EXPECT_TRUE(std::filesystem::exists(pictures / "motion" / "motion_00005.png"));

  std::ofstream(folder.results() / "motion" / "mechanism_00000.vtp") << "broken";
  expect_answer(gestell("show '" + folder.results().string() + "' --quiet -o '" + pictures.string() + "'"), 2,
                {"mechanism_00000.vtp: is not a surface of VTK"});
}

} // namespace
} // namespace gestell::tests
