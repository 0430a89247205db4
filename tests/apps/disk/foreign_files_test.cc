// Files of a user in folders for results, by every command.

#include "tests/support/program.h"

#include <map>

namespace gestell::tests
{
namespace
{

namespace fs = std::filesystem;

const std::string press_scene = scene("press_minimal.toml") + " --set run.step=20e-6 --set run.end=0.1 ";

/// Names that commands write, with something of a user in them; and some that none writes.
std::map<std::string, std::string> put_files(const fs::path &folder, const std::vector<std::string> &names)
{
  std::map<std::string, std::string> all;
  for (const std::string &name : names)
  {
    fs::create_directories((folder / name).parent_path());
    std::ofstream(folder / name) << (all[name] = "of the user: " + name);
  }
  return all;
}

void expect_unchanged(const fs::path &folder, const std::map<std::string, std::string> &all)
{
  for (const auto &[name, text] : all)
    EXPECT_EQ(read(folder / name), text) << name;
}

std::vector<std::string> commands()
{
  return {"run " + press_scene,
          "modes " + press_scene,
          "frf " + press_scene + "--from frame.crown.uz --to F_P --points 5",
          "stability " + press_scene + "--zeta 0.01",
          "chart " + press_scene + "--quick --no-peers --methods bdf-2 --steps '100 us' --samples 50",
          "periodic " + press_scene + "--method averaging"};
}

TEST(ForeignFiles, ThatNoCommandWritesStay)
{
  const Folder folder("foreign");
  const auto   all = put_files(folder.results(), {"notes.txt", "charts/mine.svg", "motion/mine.vtp", "forces/mine.vtp",
                                                  "frame_modes/old.vtp", "unfinished-thesis.txt", "pictures/mine.png"});
  for (const std::string &command : commands())
  {
    gestell(command + folder.option());
    gestell(command + folder.option());
    expect_unchanged(folder.results(), all);
  }
}

TEST(ForeignFiles, InThePlaceOfResultsRefuseEveryCommandBeforeItComputes)
{
  for (const std::string &command : commands())
  {
    const Folder folder("in_the_way");
    const auto   all = put_files(folder.results(), {"history.csv", "modes.csv", "summary.json", "report.html",
                                                    "chart.csv", "stability.html", "frf.csv"});
    expect_answer(gestell(command + folder.option()), 2, {"was not written by gestell", "-o DIR"});
    expect_unchanged(folder.results(), all);
  }
}

TEST(ForeignFiles, BehindLinksStay)
{
  const Folder folder("links");
  const auto   all = put_files(folder / "own", {"1-forces.svg", "machine.svg", "x.vtp"});
  fs::create_directories(folder.results());
  fs::create_directory_symlink(folder / "own", folder.results() / "charts");
  expect_answer(gestell("run " + press_scene + folder.option()), 2, {"charts is a link"});
  expect_unchanged(folder / "own", all);
  fs::remove(folder.results() / "charts");
  EXPECT_EQ(gestell("run " + press_scene + folder.option()).exit_code, 0);
  fs::remove_all(folder.results() / "motion");
  fs::create_directory_symlink(folder / "own", folder.results() / "motion");
  expect_answer(gestell("run " + press_scene + folder.option()), 2, {"motion is a link"});
  expect_unchanged(folder / "own", all);
}

TEST(Inputs, AreNotReplacedByResults)
{
  const Folder folder("inputs");
  ASSERT_EQ(gestell("run " + press_scene + folder.option()).exit_code, 0);
  const std::string history = read(folder.results() / "history.csv");
  const std::string where   = "'" + (folder.results() / "history.csv").string() + "'";
  gestell("chart " + press_scene + "--quick --no-peers --methods bdf-2 --steps '100 us' --samples 50 --reference " +
          where + folder.option());
  EXPECT_EQ(read(folder.results() / "history.csv"), history);
  EXPECT_TRUE(fs::exists(folder.results() / "summary.json"));
  EXPECT_TRUE(fs::exists(folder.results() / "chart.csv"));
  ASSERT_EQ(gestell("frf " + press_scene + "--from frame.crown.uz --to F_P --points 5" + folder.option()).exit_code, 0);
  expect_answer(gestell("frf " + press_scene + "--from frame.crown.uz --to F_P --points 5 --measured '" +
                        (folder.results() / "frf.csv").string() + "'" + folder.option()),
                2, {"frf.csv is an input of this command"});
}

// A scene that a command left among its results runs from there, and stays.
TEST(Inputs, AmongResultsStay)
{
  const Folder folder("scene_inside");
  ASSERT_EQ(gestell("run " + press_scene + folder.option()).exit_code, 0);
  std::ofstream(folder.results() / "sized.toml")
      << "extends = '" GESTELL_SOURCE_DIR "/apps/scenes/press_minimal.toml'\n"
         "[run]\nstep = 20e-6\nend = 0.1\n";
  std::ofstream(folder.results() / ".gestell-files", std::ios::app) << "sized.toml\n";
  const std::string own = "'" + (folder.results() / "sized.toml").string() + "'";
  EXPECT_EQ(gestell("run " + own + folder.option()).exit_code, 0);
  EXPECT_TRUE(fs::exists(folder.results() / "sized.toml"));
}

TEST(ForeignFiles, OfAStudyStay)
{
  const Folder      folder("study_foreign");
  const std::string study =
      "study " +
      folder.file("s.toml", "[scene]\nfile = '" GESTELL_SOURCE_DIR "/apps/scenes/press_minimal.toml'\n"
                            "set = { 'run.step' = 20e-6, 'run.end' = 0.1 }\n"
                            "[variables.c_P]\nfrom = '720 kN/mm'\nto = '1080 kN/mm'\n"
                            "[outputs]\nF = 'signals.F_P.max'\n[design]\ntype = 'Sobol'\nruns = 3\n") +
      folder.option();
  const auto all = put_files(folder.results(), {"charts/mine.svg", "charts/sub/deep.txt", "notes.txt"});
  EXPECT_EQ(gestell(study).exit_code, 0);
  EXPECT_EQ(gestell(study).exit_code, 0);
  expect_unchanged(folder.results(), all);
  fs::remove(folder.results() / "report.html");
  fs::remove(folder.results() / ".gestell-files");
  const auto page = put_files(folder.results(), {"report.html"});
  expect_answer(gestell(study), 2, {"was not written by gestell"});
  expect_unchanged(folder.results(), page);
}

TEST(ForeignFiles, ThatAreNamedByMistakeAreNotReplacedByAnFmu)
{
  const Folder folder("fmu_foreign");
  const auto   all = put_files(folder / "", {"notes.toml"});
  expect_answer(gestell("export " + press_scene + "--fmu '" + (folder / "notes.toml").string() + "'"), 2,
                {"is not an FMU"});
  expect_unchanged(folder / "", all);
}

} // namespace
} // namespace gestell::tests
