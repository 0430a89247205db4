#include "tests/support/program.h"

namespace gestell::tests
{
namespace
{

const std::string text = "[scene]\nfile = '" GESTELL_SOURCE_DIR "/apps/scenes/press_minimal.toml'\n"
                         "[variables.c_P]\nfrom = '720 kN/mm'\nto = '1080 kN/mm'\n"
                         "[outputs]\nF = 'signals.F_P.max'\n"
                         "[design]\ntype = 'Sobol'\nruns = 40\n";

int lines_of(const std::filesystem::path &file)
{
  return count(read(file), "\n");
}

TEST(StudyCommand, LeavesItsRowsAndGoesOnAfterAnInterruption)
{
  const Folder      folder("study_interrupted");
  const std::string study = "study " + folder.file("s.toml", text) + folder.option();
  const Answer      cut   = gestell(study + "& p=$!; while [ $(wc -l < '" + (folder.results() / "runs.csv").string() +
                                    "' 2>/dev/null || echo 0) -lt 4 ]; do sleep 0.02; done; kill -INT $p; wait $p");
  expect_answer(cut, 130, {"runs made", "to be made"});
  const std::string before = read(folder.results() / "runs.csv");
  EXPECT_LT(lines_of(folder.results() / "runs.csv"), 41);
  expect_answer(gestell(study), 2, {"of 40 rows of this study; go on with --resume"});
  expect_answer(gestell(study + "--resume --set design.runs=41"), 2, {"design.runs was 40, is 41"});
  std::ofstream(folder.results() / "runs.csv", std::ios::app) << "40,done,7"; // as a crash leaves it
  expect_answer(gestell(study + "--resume --jobs 2"), 0, {"report: "});
  EXPECT_EQ(lines_of(folder.results() / "runs.csv"), 41);
  EXPECT_EQ(read(folder.results() / "runs.csv").substr(0, before.size()), before);
}

TEST(StudyCommand, FindsTheOptimumAndWritesItAsAScene)
{
  const Folder folder("study_optimum");
  expect_answer(gestell("study '" GESTELL_SOURCE_DIR "/apps/studies/press_24.toml'" + folder.option()), 0,
                {"24 runs made", "optimum on the surface", "play = -1", "by a run -501.09 kN"});
  for (const char *file : {"runs.csv", "surface.csv", "effects.csv", "report.html", "optimum.toml", "optimum_runs.csv"})
    EXPECT_TRUE(std::filesystem::exists(folder.results() / file)) << file;
  const auto again = (folder / "again").string();
  EXPECT_EQ(gestell("run '" + (folder.results() / "optimum.toml").string() + "' --quiet -o '" + again + "'").exit_code,
            0);
  EXPECT_NEAR(json_number(read(again + "/summary.json"), {"signals", "F_P", "min"}), -501088.6, 1.);
}

} // namespace
} // namespace gestell::tests
