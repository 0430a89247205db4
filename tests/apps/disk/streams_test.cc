// Standard output that is full, closed, or read by a program that wants a part of it.

#include "tests/support/program.h"

namespace gestell::tests
{
namespace
{

const std::string modes = "modes " + scene("press_minimal.toml");

TEST(StandardOutput, ThatIsFullIsAnErrorAndResultsAreThere)
{
  const Folder folder("full_output");
  expect_answer(gestell(modes + folder.option() + ">/dev/full"), 3, {"standard output: cannot be written (No space"});
  EXPECT_TRUE(std::filesystem::exists(folder.results() / "summary.json"));
  expect_answer(gestell("help run.step >/dev/full"), 3, {"standard output"});
  expect_answer(gestell(modes + " --json" + folder.option() + ">/dev/full"), 3, {"standard output"});
}

// The first file that is opened would get its number.
TEST(StandardOutput, ThatIsClosedDoesNotGoIntoAFile)
{
  const Folder folder("closed_output"), open("open_output");
  EXPECT_EQ(gestell(modes + folder.option() + ">&-").exit_code, 3);
  EXPECT_EQ(gestell(modes + folder.option() + "2>&- >/dev/null").exit_code, 0);
  EXPECT_EQ(gestell(modes + open.option()).exit_code, 0);
  EXPECT_EQ(read(folder.results() / "modes.csv"), read(open.results() / "modes.csv"));
}

TEST(StandardOutput, WhoseReaderEndsEndsNoComputation)
{
  const Folder folder("reader_ends");
  const Answer answer =
      shell("bash -c \"GESTELL_CACHE='" GESTELL_BINARY_DIR "/tests/cache' '" GESTELL_BINARY_DIR "/bin/gestell' " +
            modes + folder.option() + "| head -c 1 >/dev/null; exit \\${PIPESTATUS[0]}\"");
  expect_answer(answer, 0, {});
  EXPECT_TRUE(std::filesystem::exists(folder.results() / "summary.json"));
}

} // namespace
} // namespace gestell::tests
