// Whichever call fails that changes a file, the program tells it, leaves whole files alone and works the next time.

#include "tests/apps/disk/disk_cases.h"

namespace gestell::tests
{
namespace
{

TEST(FailedWrite, IsReportedAndLeavesWholeFilesInEveryCommand)
{
  const DiskCases cases;
  EXPECT_GT(fail_writes(cases, 2), 0);
}

/// Words before a command that let every call on this file fail.
std::string full_disk(const DiskCases &cases, const std::filesystem::path &file)
{
  std::ofstream(cases.path("calls"), std::ios::binary) << std::string(sizeof(long), '\0');
  return "GESTELL_DISK='" + file.string() + "' GESTELL_DISK_COUNT='" + cases.path("calls").string() +
         "' GESTELL_DISK_CALL=1 GESTELL_DISK_FULL=1 LD_PRELOAD='" GESTELL_BINARY_DIR "/tests/gestell_failing_disk.so' ";
}

// The history of a run whose folder is full is in the folder for temporary files.
TEST(FailedWrite, LosesNoHistory)
{
  const DiskCases cases;
  const Folder    folder("full_disk");
  const DiskCase &run = cases.all().front();
  ASSERT_EQ(run.name, "run");
  std::filesystem::create_directories(folder.results());
  const std::string full   = full_disk(cases, folder.results() / "history.csv");
  const Answer      answer = shell(cases.command(run, folder.results(), "", full));
  expect_answer(answer, 3,
                {"history.csv: cannot be written (No space left on device)", "all results are in ", " instead"});
  EXPECT_FALSE(std::filesystem::exists(folder.results() / "history.csv"));
  EXPECT_NE(read(folder.results() / "summary.json").find("history.csv: cannot be written"), std::string::npos);
  const auto                  begin     = answer.text.find("all results are in ") + 19;
  const std::filesystem::path elsewhere = answer.text.substr(begin, answer.text.find(" instead") - begin);
  EXPECT_GT(read(elsewhere / "history.csv").size(), 1000u);
}

// Interrupted, it says whether the run can go on, too.
TEST(FailedWrite, OfAnInterruptedRunReportsWhetherItCanGoOn)
{
  const DiskCases cases;
  const Folder    folder("full_disk");
  std::filesystem::create_directories(folder.results());
  const std::string run =
      "timeout --preserve-status -s INT 2 '" GESTELL_BINARY_DIR "/bin/gestell' run " + scene("press_minimal.toml") +
      " --set run.end=90 --set run.step=2e-6 --set output.step=0.01 --checkpoint 0.05" + folder.option();
  expect_answer(shell(full_disk(cases, folder.results() / "history.csv") + run), 3,
                {"history.csv: cannot be written", "the run was interrupted; gestell run ", "--set run.end=90",
                 "--resume -o ", "continues from its last checkpoint"});
}

} // namespace
} // namespace gestell::tests
