// 200 runs, 20 at a time, below new folders, into one, on a frame that none has yet, while others prune the cache and
// make shares of a study: none is lost.

#include "tests/support/cached_frame.h"
#include "tests/support/side_by_side.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

constexpr int at_once = 20;

const std::string press = scene("press_minimal.toml") + " --quiet --set run.end=0.01 ";

/// Whole, or refused with a message.
void expect_none_lost(const std::vector<Answer> &answers, const std::function<bool(int)> &is_whole)
{
  long whole = 0, refused = 0;
  for (std::size_t i = 0; i < answers.size(); ++i)
    if (answers[i].exit_code == 0 && is_whole(int(i) + 1))
      ++whole;
    else if (answers[i].exit_code == 2 && answers[i].says("; wait until it ends"))
      ++refused;
    else
      ADD_FAILURE() << "call " << i + 1 << ": " << answers[i].exit_code << "\n" << answers[i].text;
  std::cout << answers.size() << " calls: " << whole << " whole, " << refused << " refused with a message\n";
  EXPECT_GE(whole, 1);
}

bool has_results(const std::filesystem::path &folder)
{
  return std::filesystem::exists(folder / "summary.json") && read(folder / "history.csv").size() > 1000 &&
         read(folder / "report.html").find("</html>") != std::string::npos;
}

} // namespace

TEST(ManySideBySide, BelowOneNewFolder)
{
  const Folder folder("many_below");
  const auto   answers =
      side_by_side(folder, 60, at_once, "run " + press + "-o " + (folder / "new/deep").string() + "/%1");
  EXPECT_EQ(ended_with(answers, 0), 60);
  expect_none_lost(answers, [&](int i) { return has_results(folder / "new/deep" / std::to_string(i)); });
}

TEST(ManySideBySide, IntoOneFolder)
{
  const Folder folder("many_one");
  const auto   answers = side_by_side(folder, 60, at_once, "run " + press + "--checkpoint 0.001 " + folder.option());
  expect_none_lost(answers, [&](int) { return has_results(folder.results()); });
}

TEST(ManySideBySide, OnAFrameThatNoneHasYetAndWhichIsPruned)
{
  const Folder      folder("many_frames");
  const std::string chain  = folder.file("chain.toml", test::reduced_chain);
  const std::string run    = "run " + chain + " --quiet --set run.end=0.01 -o " + (folder / "new").string() + "/%1",
                    reduce = "reduce " + chain + " --quiet -o " + (folder / "new").string() + "/%1",
                    prune  = "reduce --prune --all";
  const auto answers       = side_by_side(folder, 60, at_once,
                                          "--version >/dev/null; gestell() { '" GESTELL_BINARY_DIR "/bin/gestell' \"$@\"; }; "
                                                "export GESTELL_CACHE='" +
                                              (folder / "cache").string() +
                                              "'; "
                                                    "case $(($1 % 3)) in 0) gestell " +
                                              run + ";; 1) gestell " + reduce + ";; 2) gestell " + prune + ";; esac");
  EXPECT_EQ(ended_with(answers, 0), 60);
  expect_none_lost(answers,
                   [&](int i)
                   {
                     const auto own = folder / "new" / std::to_string(i);
                     return i % 3 == 2 ||
                            (i % 3 == 0 ? has_results(own) : std::filesystem::exists(own / "reduced_frame.h5"));
                   });
}

TEST(ManySideBySide, SharesOfAStudy)
{
  const Folder      folder("many_shares");
  const std::string study =
      folder.file("s.toml", "[scene]\nfile = '" GESTELL_SOURCE_DIR "/apps/scenes/press_minimal.toml'\n"
                            "set = { \"run.end\" = '10 ms' }\n"
                            "[variables.c_P]\nfrom = '720 kN/mm'\nto = '1080 kN/mm'\n"
                            "[outputs]\nF = 'signals.F_P.max'\n[design]\ntype = 'Sobol'\nruns = 40\n");
  const auto answers = side_by_side(folder, 20, at_once, "study " + study + folder.option() + "--share %1/20");
  EXPECT_EQ(ended_with(answers, 0), 20);
  expect_answer(gestell("study " + study + folder.option()), 0, {"report: "});
  EXPECT_EQ(count(read(folder.results() / "runs.csv"), ",done,"), 40);
}

} // namespace gestell::tests
