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

/// Shell words that wait for rows of a study that was begun in the background as $p.
std::string wait_for_rows(const Folder &folder, int rows)
{
  return "& p=$!; while [ $(wc -l < '" + (folder.results() / "runs.csv").string() + "' 2>/dev/null || echo 0) -lt " +
         std::to_string(rows + 1) + " ]; do sleep 0.01; done; ";
}

TEST(StudyCommand, LeavesItsRowsAndGoesOnAfterAnInterruption)
{
  const Folder      folder("study_interrupted");
  const std::string study = "study " + folder.file("s.toml", text) + folder.option();
  const Answer      cut   = gestell(study + wait_for_rows(folder, 3) + "kill -INT $p; wait $p");
  expect_answer(cut, 130, {"runs made", " remaining"});
  const std::string before = read(folder.results() / "runs.csv");
  EXPECT_LT(lines_of(folder.results() / "runs.csv"), 41);
  expect_answer(gestell(study), 2, {"of 40 rows of this study; continue with --resume"});
  expect_answer(gestell(study + "--resume --set design.runs=41"), 2, {"design.runs was 40, is 41"});
  std::ofstream(folder.results() / "runs.csv", std::ios::app) << "40,done,7"; // as a crash leaves it
  expect_answer(gestell(study + "--resume --jobs 2"), 0, {"report: "});
  EXPECT_EQ(lines_of(folder.results() / "runs.csv"), 41);
  EXPECT_EQ(read(folder.results() / "runs.csv").substr(0, before.size()), before);
}

// A cluster tells all processes of a job that its time is over.
TEST(StudyCommand, HasNoFailedRowOfRunsThatEndedWithIt)
{
  const Folder      folder("study_term");
  const std::string study = "study " + folder.file("s.toml", text) + folder.option() + "--jobs 3 ";
  const Answer      cut =
      shell("GESTELL_CACHE='" GESTELL_BINARY_DIR "/tests/cache' setsid '" GESTELL_BINARY_DIR "/bin/gestell' " + study +
            wait_for_rows(folder, 3) + "kill -TERM -$p; wait $p");
  expect_answer(cut, 130, {"runs made", " remaining"});
  EXPECT_EQ(count(read(folder.results() / "runs.csv"), "failed"), 0);
  expect_answer(gestell(study + "--resume"), 0, {"report: "});
  EXPECT_EQ(count(read(folder.results() / "runs.csv"), ",done,"), 40);
}

// Each would replace the report of the other.
TEST(StudyCommand, SharesNoFolderWithARun)
{
  const Folder      run("study_beside_run"), own("study_before_run");
  const std::string scene_of_run = scene("press_minimal.toml") + " --set run.end=0.001 --set run.energy=false";
  ASSERT_EQ(gestell("run " + scene_of_run + run.option()).exit_code, 0);
  EXPECT_NE(read(run.results() / "summary.json").find("\"energy\": null"), std::string::npos); // no perfect balance
  const std::string report = read(run.results() / "report.html");
  const std::string study  = "study " + own.file("s.toml", text) + " --set design.runs=4 ";
  expect_answer(gestell(study + run.option()), 2, {"contains results of another command", "-o DIR"});
  EXPECT_EQ(read(run.results() / "report.html"), report);

  ASSERT_EQ(gestell(study + own.option() + "--share 1/2").exit_code, 0);
  const std::string list = read(own.results() / ".gestell-files");
  EXPECT_NE(list.find("study.json\n"), std::string::npos) << list;
  EXPECT_NE(list.find("runs_share_1_of_2.csv\n"), std::string::npos) << list;
  expect_answer(gestell("run " + scene_of_run + own.option()), 2, {"it contains a study", "-o DIR"});
}

TEST(StudyCommand, IsNotBegunTwiceInOneFolderAtOnce)
{
  const Folder      folder("study_twice");
  const std::string study  = "study " + folder.file("s.toml", text) + folder.option() + "--set design.runs=12 ";
  const std::string second = "'" GESTELL_BINARY_DIR "/bin/gestell' " + study;
  const Answer      both   = gestell(study + wait_for_rows(folder, 1) + "kill -STOP $p; (" + second + "; " + second +
                                     "--resume --share 1/2) 2>&1; " + "echo first is $p; kill -CONT $p; wait $p");
  const std::size_t at     = both.text.rfind("first is ");
  const std::string first  = both.text.substr(at + 9, both.text.find('\n', at) - at - 9);
  EXPECT_EQ(both.exit_code, 0) << both.text;
  EXPECT_EQ(count(both.text, "process " + first + " on "), 2) << both.text;
  EXPECT_EQ(count(both.text, " is running a study there; wait until it ends"), 2) << both.text;
  EXPECT_EQ(count(read(folder.results() / "runs.csv"), ",done,"), 12);
}

TEST(StudyCommand, DoesNotMergeSharesThatAreBeingMade)
{
  const Folder      folder("study_shares");
  const std::string study = "study " + folder.file("s.toml", text) + folder.option() + "--set design.runs=12 ";
  const std::string rows  = "'" + (folder.results() / "runs_share_1_of_2.csv").string() + "'";
  const Answer      both =
      gestell(study + "--share 1/2 & p=$!; while ! [ -s " + rows + " ]; do sleep 0.01; done; kill -STOP $p; '" +
              GESTELL_BINARY_DIR "/bin/gestell' " + study + "2>&1; kill -CONT $p; wait $p");
  expect_answer(both, 0, {"is running a share of a study there", "6 runs made"});
  expect_answer(gestell(study), 0, {"6 runs made"});
  EXPECT_EQ(count(read(folder.results() / "runs.csv"), ",done,"), 12);
  expect_answer(gestell(study + "--share 2/2"), 2, {"contains 12 rows of this study; complete them"});
}

/// A search on runs of the press, and draws about what it finds.
const std::string search = "[scene]\nfile = '" GESTELL_SOURCE_DIR "/apps/scenes/press_minimal.toml'\n"
                           "set = { run = { method = 'bdf', tolerance = 1e-5, end = '50 ms' } }\n"
                           "[variables.c_P]\nfrom = '720 kN/mm'\nto = '1080 kN/mm'\n"
                           "scatter = 'normal'\nwidth = '10 kN/mm'\n"
                           "[outputs]\nF = 'signals.F_P.max'\nnever = 'events.sheet.tool_contact.first'\n"
                           "[design]\ntype = 'list'\nrows = [['900 kN/mm']]\n"
                           "[optimise]\non = 'runs'\nmethod = 'derivative-free'\ngoals = { F = { scale = '1 MN' } }\n"
                           "robust = { on = 'runs', draws = 12 }\n";

TEST(StudyCommand, SearchesAndDrawsSideBySideAsOneAfterAnother)
{
  const Folder one("study_search_one"), two("study_search_two");
  for (const auto &[folder, jobs] : {std::pair(&one, "1"), {&two, "3"}})
    expect_answer(gestell("study " + folder->file("s.toml", search) + folder->option() + "--jobs " + jobs), 0,
                  {"optimum on ", "scatter: F"});
  EXPECT_EQ(read(two.results() / "optimum.toml"), read(one.results() / "optimum.toml"));
  EXPECT_EQ(read(two.results() / "robust.csv"), read(one.results() / "robust.csv"));
  EXPECT_EQ(count(read(one.results() / "robust.csv"), "runs,F [N],12,0,,"), 0); // the nominal value is told
  const Folder slopes("study_search_slopes");
  const Answer warned = gestell("study " + slopes.file("s.toml", search) + slopes.option() +
                                "--set optimise.method=gradient --set optimise.starts=1");
  expect_answer(warned, 0, {"gestell: warning: the search with runs used difference quotients"});
  EXPECT_EQ(count(read(slopes.results() / "findings.txt"), "warning: the search with runs used difference quotients"),
            1);
}

TEST(StudyCommand, IsInterruptedInSearchesAndKeepsTheirRows)
{
  for (const char *jobs : {"1", "2"})
  {
    const Folder      folder("study_search_cut");
    const std::string rows = "'" + (folder.results() / "optimum_runs.csv").string() + "'";
    const Answer      cut  = gestell("study " + folder.file("s.toml", search) + folder.option() + "--jobs " + jobs +
                                     " --set optimise.robust.draws=5000 2>&1 & p=$!; while [ $(cat " + rows +
                                     " 2>/dev/null | wc -l) -lt 5 ]; do sleep 0.01; done; kill -INT $p; wait $p");
    expect_answer(cut, 130, {"interrupted: results are incomplete"});
    EXPECT_GE(count(read(folder.results() / "optimum_runs.csv"), ",done,"), 4);
  }
}

TEST(StudyCommand, RefusesALimitInAnotherUnitAtItsFirstRunAndGoesOnOnceThatIsCured)
{
  const Folder      folder("study_unit");
  const std::string study = "study " + folder.file("s.toml", text) + folder.option() +
                            "--set design.runs=6 --set optimise.goals.F.scale=\"1 kN\" ";
  expect_answer(gestell(study + "--set optimise.limits.F.most=\"5 mm\""), 2,
                {"optimise.limits.F.most: is in m, but output F is in N"});
  EXPECT_EQ(count(read(folder.results() / "runs.csv"), ",done,"), 1);
  expect_answer(gestell(study + "--resume"), 0, {"5 runs made", "optimum on the surface"});
}

TEST(StudyCommand, LinksTheRunsThatItKeeps)
{
  const Folder folder("study_kept");
  expect_answer(gestell("study " + folder.file("s.toml", text) + folder.option() +
                        "--set design.runs=4 --set run.end=\"5 ms\" --set keep=true --set optimise.goals.F.scale=1"),
                0, {", run "});
  const std::string page = read(folder.results() / "report.html");
  for (const char *run : {"run_1", "run_4", "run_5"}) // the last verifies the optimum
  {
    const std::string link = std::string(run) + "/report.html";
    EXPECT_EQ(count(page, "href=\"" + link + '"'), 1) << link;
    EXPECT_TRUE(std::filesystem::exists(folder.results() / link));
  }
}

// A cosine of 44 000 turns over the range, 5509.2 from one run to the next, is noise to a parabola.
TEST(StudyCommand, WarnsOfASurfaceThatForetellsNothing)
{
  const Folder folder("study_poor");
  const Answer answer = gestell("study " + folder.file("s.toml", text) + folder.option() +
                                "--set design.runs=7 --set run.end=\"5 ms\" --set surface={} "
                                "--set 'outputs.n=\"cos(c_P/(1.3 N/mm))\"'");
  expect_answer(answer, 0, {"gestell: warning: the surface of n predicts runs outside its fit"});
  EXPECT_EQ(count(read(folder.results() / "findings.txt"), "the surface of n predicts"), 1);
}

TEST(StudyCommand, FindsTheOptimumAndWritesItAsAScene)
{
  const Folder folder("study_optimum");
  expect_answer(gestell("study '" GESTELL_SOURCE_DIR "/apps/studies/press_24.toml'" + folder.option()), 0,
                {"24 runs made", "optimum on the surface", "play = -1", "run -501.09 kN"});
  for (const char *file : {"runs.csv", "surface.csv", "effects.csv", "report.html", "optimum.toml", "optimum_runs.csv"})
    EXPECT_TRUE(std::filesystem::exists(folder.results() / file)) << file;
  const auto again = (folder / "again").string();
  EXPECT_EQ(gestell("run '" + (folder.results() / "optimum.toml").string() + "' --quiet -o '" + again + "'").exit_code,
            0);
  EXPECT_NEAR(json_number(read(again + "/summary.json"), {"signals", "F_P", "min"}), -501088.6, 1.);
}

} // namespace
} // namespace gestell::tests
