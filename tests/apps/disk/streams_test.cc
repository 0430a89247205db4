// Standard output that is full, closed, or read by a program that wants a part of it.

#include "tests/support/program.h"

namespace gestell::tests
{
namespace
{

const std::string modes = "modes " + scene("press_minimal.toml");

/// With redirections that are those of the program alone, not of what this test hears.
Answer redirected(const std::string &arguments)
{
  return shell("(GESTELL_CACHE='" GESTELL_BINARY_DIR "/tests/cache' '" GESTELL_BINARY_DIR "/bin/gestell' " + arguments +
               ")");
}

TEST(StandardOutput, ThatIsFullIsAnErrorAndResultsAreThere)
{
  const Folder folder("full_output");
  expect_answer(redirected(modes + folder.option() + ">/dev/full"), 3,
                {"standard output: cannot be written (No space"});
  EXPECT_TRUE(std::filesystem::exists(folder.results() / "summary.json"));
  expect_answer(redirected("help run.step >/dev/full"), 3, {"standard output"});
  expect_answer(redirected(modes + " --json" + folder.option() + ">/dev/full"), 3, {"standard output"});
}

// The first file that is opened would get its number.
TEST(StandardOutput, ThatIsClosedDoesNotGoIntoAFile)
{
  const Folder folder("closed_output"), open("open_output");
  EXPECT_EQ(redirected(modes + folder.option() + ">&-").exit_code, 3);
  EXPECT_EQ(redirected(modes + folder.option() + "2>&- >/dev/null").exit_code, 0);
  EXPECT_EQ(redirected(modes + open.option()).exit_code, 0);
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
