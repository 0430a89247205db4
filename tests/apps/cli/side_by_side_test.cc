// Runs at the same time: whatever they share, each is whole or refused with a message.

#include "tests/support/side_by_side.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

namespace fs = std::filesystem;

const std::string press_file = scene("press_minimal.toml") + " --quiet --set run.end=0.01 ";
/// Takes longer than a process needs to see that it has begun; energy and pictures keep it busy.
const std::string long_press = scene("press_minimal.toml") + " --quiet --set run.end=2 ";

bool is_whole(const fs::path &folder, const std::string &history)
{
  return read(folder / "history.csv") == history && read(folder / "report.html").find("</html>") != std::string::npos &&
         fs::exists(folder / "summary.json") && !fs::exists(folder / ".gestell-lock");
}

/// The history of the run by itself.
std::string alone()
{
  const Folder folder("alone");
  expect_answer(gestell("run " + press_file + folder.option()), 0, {"report: "});
  return read(folder.results() / "history.csv");
}

} // namespace

TEST(SideBySide, RunsBelowOneNewFolderAreAllWhole)
{
  const std::string history = alone();
  const Folder      folder("side_below");
  constexpr int     n = 8;
  const auto answers = side_by_side(folder, n, n, "run " + press_file + "-o " + (folder / "new/deep").string() + "/%1");
  for (int i = 1; i <= n; ++i)
  {
    EXPECT_EQ(answers[i - 1].exit_code, 0) << answers[i - 1].text;
    EXPECT_TRUE(is_whole(folder / "new/deep" / std::to_string(i), history)) << i << answers[i - 1].text;
  }
}

TEST(SideBySide, RunsIntoOneFolderLeaveAWholeOneAndRefuseTheRest)
{
  const std::string history = alone();
  const Folder      folder("side_one");
  const auto        answers = side_by_side(folder, 8, 8, "run " + press_file + folder.option());
  for (const Answer &answer : answers)
    if (answer.exit_code != 0)
      expect_answer(answer, 2,
                    {": process ", " on ", " is computing results for this folder; wait until it ends, or "});
  EXPECT_GE(ended_with(answers, 0), 1);
  EXPECT_TRUE(is_whole(folder.results(), history));
}

namespace
{

/// A run in the background that holds its folder, stopped; then `second`, and the first goes on.
Answer beside_a_stopped_one(const Folder &folder, const std::string &second, const std::string &signal)
{
  const std::string lock = "'" + (folder.results() / ".gestell-lock").string() + "'";
  return shell("(GESTELL_CACHE='" GESTELL_BINARY_DIR "/tests/cache' '" GESTELL_BINARY_DIR "/bin/gestell' run " +
               long_press + folder.option() + ">/dev/null & p=$!; while kill -0 $p 2>/dev/null && ! [ -s " + lock +
               " ]; do sleep 0.005; done; kill -STOP $p; '" GESTELL_BINARY_DIR "/bin/gestell' " + second +
               "; echo \"second: $?, first is $p\"; kill -" + signal +
               " $p; wait $p)"); // the brackets for its error output, too
}

} // namespace

TEST(SideBySide, TheProcessThatHoldsAFolderIsNamed)
{
  for (const std::string command : {"run ", "modes ", "periodic "})
  {
    const Folder      folder("side_named");
    const Answer      both  = beside_a_stopped_one(folder, command + press_file + folder.option(), "CONT");
    const std::string first = both.text.substr(both.text.find("first is ") + 9);
    EXPECT_EQ(both.exit_code, 0) << both.text;
    EXPECT_TRUE(both.says("second: 2")) << both.text;
    EXPECT_TRUE(both.says(": process " + first.substr(0, first.find('\n')) + " on ")) << both.text;
    EXPECT_TRUE(fs::exists(folder.results() / "summary.json"));
  }
}

TEST(SideBySide, TheLockOfADeadProcessIsNone)
{
  const Folder folder("side_dead");
  const Answer dead = beside_a_stopped_one(folder, "--version", "KILL");
  EXPECT_EQ(dead.exit_code, 137) << dead.text;
  ASSERT_TRUE(fs::exists(folder.results() / ".gestell-lock"));
  expect_answer(gestell("run " + press_file + folder.option()), 0, {"report: "});
  EXPECT_FALSE(fs::exists(folder.results() / ".gestell-lock"));
}

TEST(SideBySide, ARunThatIsRefusedLeavesNoFolder)
{
  const Folder folder("side_refused");
  expect_answer(gestell("run " + press_file + "--set run.step=1 -o " + (folder / "new/deep").string()), 2,
                {"run.step"});
  EXPECT_FALSE(fs::exists(folder / "new"));
}

} // namespace gestell::tests
