#include "tests/apps/pages/page_measures.h"
#include "tests/support/program.h"

using namespace gestell;
using tests::Browser;

/// What the press on its frame of finite elements must reach on a machine without graphics.  What others do on the
/// machine at the time of the test is not the page's: 30 pictures a second are reached if a picture takes a thirtieth
/// of a second of one processor, in all processes of the browser, and it opens in two on a quiet
/// machine; others are half as fast.
TEST(PressPage, IsBelow5MBOpensWithin4SecondsAndMovesAt30PicturesASecond)
{
  GESTELL_NEEDS_BROWSER();
  const tests::Folder folder("press_page");
  tests::expect_answer(tests::gestell("run " + tests::scene("press.toml") + folder.option()), 0, {});
  const auto report = folder.results() / "report.html";
  EXPECT_LT(std::filesystem::file_size(report), 5000000u);

  Browser page(report);
  EXPECT_TRUE(page.load_seconds() < 4. || page.load_cpu_seconds() < 4.)
      << page.load_seconds() << " s, " << page.load_cpu_seconds() << " s of processors";
  const double      seen = tests::seconds_to_the_machine(page);
  const tests::Pace pace = tests::pace(page, 4);
  EXPECT_TRUE(pace.pictures_per_second >= 30. || pace.cpu_per_picture <= 1. / 30.)
      << pace.pictures_per_second << " pictures a second, " << pace.cpu_per_picture << " s of processors each";
  EXPECT_TRUE(page.errors().empty()) << tests::texts(page.errors());
  EXPECT_TRUE(page.requests().empty()) << tests::texts(page.requests());
  std::cout << "opened in " << page.load_seconds() << " s with " << page.load_cpu_seconds()
            << " s of processors, machine seen after " << seen << " s, " << pace.pictures_per_second
            << " pictures a second, " << pace.cpu_per_picture << " s of processors each\n";
}

TEST(PressPage, BesideAnotherPressIsBelow5MB)
{
  const tests::Folder folder("press_page_compared");
  tests::expect_answer(tests::gestell("run " + tests::scene("press.toml") + " --compare " +
                                      tests::scene("press_minimal_light.toml") + folder.option()),
                       0, {});
  EXPECT_LT(std::filesystem::file_size(folder.results() / "report.html"), 5000000u);
}
