// The command `gestell frf`: its files, and what it says of odd input.

#include "tests/support/program.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

const std::string press = "frf " + scene("press_minimal.toml") + " ";

} // namespace

TEST(FrfCommand, WritesTableSummaryAndReport)
{
  const Folder folder("frf");
  const auto   answer = gestell(press + "--from frame.crown.uz --to frame.table.uz,F_P --points 50" + folder.option());
  expect_answer(answer, 0,
                {"The receptance of the machine linearised in the initial state, in motion",
                 "frame.table.uz/frame.crown.uz [m/N]", "F_P/frame.crown.uz [N/N]", "closed contacts: 'rod'"});
  const std::string csv = read(folder.results() / "frf.csv");
  EXPECT_EQ(csv.substr(0, csv.find("F_P")),
            "frequency [Hz],frame.table.uz/frame.crown.uz re [m/N],frame.table.uz/frame.crown.uz im [m/N],"
            "frame.table.uz/frame.crown.uz abs [m/N],frame.table.uz/frame.crown.uz phase [deg],");
  EXPECT_GE(count(csv, "\n"), 51);
  const std::string json = read(folder.results() / "summary.json");
  EXPECT_NEAR(json_number(json, {"frf", "pairs", "frequency_hz"}), 20., 2.);
  EXPECT_TRUE(std::filesystem::exists(folder.results() / "charts" / "frf-amplitude.svg"));
  EXPECT_NE(read(folder.results() / "report.html").find("<section id=\"frf\""), std::string::npos);
}

// A command that saves nothing when it is interrupted removes its lock, and its folder if it made it.
TEST(FrfCommand, InterruptedLeavesNoLockAndNoFolder)
{
  const Folder folder("frf_interrupted");
  const Answer cut = shell("(timeout --signal TERM 1 '" GESTELL_BINARY_DIR "/bin/gestell' " + press +
                           "--from frame.crown.uz --to frame.table.uz --points 900000 " + folder.option() + ")");
  EXPECT_EQ(cut.exit_code, 124) << cut.text;
  EXPECT_TRUE(cut.says("interrupted; the remaining files are not written")) << cut.text;
  EXPECT_FALSE(std::filesystem::exists(folder.results()));
}

TEST(FrfCommand, DrawsItsOwnTableAsMeasured)
{
  const Folder folder("frf_measured");
  const auto   ask = press + "--from slide --to slide --points 20 --kind mobility";
  expect_answer(gestell(ask + folder.option()), 0, {"m/s/N"});
  std::filesystem::copy(folder.results() / "frf.csv", folder / "mine.csv");
  expect_answer(gestell(ask + " --measured '" + (folder / "mine.csv").string() + "'" + folder.option()), 0, {});
  EXPECT_NE(read(folder.results() / "report.html").find("measured: slide/slide"), std::string::npos);
}

TEST(FrfCommand, KeepsARunBesideIt)
{
  const Folder folder("frf_beside");
  expect_answer(gestell("run " + scene("press_minimal.toml") + " --set run.end='\"10 ms\"'" + folder.option()), 0, {});
  const std::string report = read(folder.results() / "report.html");
  expect_answer(gestell(press + "--from slide --to slide --points 20" + folder.option()), 0,
                {"contains a run, which is kept"});
  EXPECT_EQ(read(folder.results() / "report.html"), report);
  EXPECT_TRUE(std::filesystem::exists(folder.results() / "frf.csv"));
  EXPECT_TRUE(std::filesystem::exists(folder.results() / "charts" / "frf-amplitude.svg"));
}

TEST(FrfCommand, RefusesOddInputWithTheWayOut)
{
  const Folder folder("frf_odd");
  const auto   refused = [&](const std::string &options, const std::vector<std::string> &words)
  { expect_answer(gestell(press + options + folder.option()), 2, words); };
  refused("--to slide", {"--from is missing"});
  refused("--from slide --to slide --kind compliance", {"--kind"});
  refused("--from slide --to slide --measured nowhere.csv", {"nowhere.csv", "cannot be read"});
  EXPECT_FALSE(std::filesystem::exists(folder.results() / "summary.json"));
}

} // namespace gestell::tests
