// The macro beside motion.pvd, run by ParaView itself.

#include "tests/support/program.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

TEST(ViewMacro, DrawsTheMotionInParaView)
{
  if (shell("command -v pvbatch && command -v xvfb-run && command -v xauth").exit_code != 0)
    GTEST_SKIP() << "pvbatch, xvfb-run or xauth is not installed (packages paraview, xvfb, xauth)";
  const Folder folder("pvbatch");
  expect_answer(gestell("run " + scene("press_minimal.toml") + " --set output.picture_step='\"20 ms\"'" +
                        " --set run.end='\"0.1 s\"'" + folder.option()),
                0, {});
  const Answer drawn = shell("cd '" + folder.results().string() +
                             "' && xvfb-run -a -s '-noreset -screen 0 1280x1024x24' pvbatch view.py view.png");
  EXPECT_EQ(drawn.exit_code, 0) << drawn.text;
  EXPECT_EQ(drawn.text.find("Error"), std::string::npos) << drawn.text;
  EXPECT_EQ(read(folder.results() / "view.png").substr(1, 3), "PNG");
}

} // namespace
} // namespace gestell::tests
