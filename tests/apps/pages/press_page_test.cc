#include "tests/apps/pages/page_measures.h"
#include "tests/support/program.h"

using namespace gestell;
using tests::Browser;

/// What the press on its frame of finite elements must reach on a machine without graphics.
TEST(PressPage, IsBelow5MBOpensWithin2SecondsAndMovesAt30PicturesASecond)
{
  GESTELL_NEEDS_BROWSER();
  const tests::Folder folder("press_page");
  tests::expect_answer(tests::gestell("run " + tests::scene("press.toml") + folder.option()), 0, {});
  const auto report = folder.results() / "report.html";
  EXPECT_LT(std::filesystem::file_size(report), 5000000u);

  Browser page(report);
  EXPECT_LT(page.load_seconds(), 2.);
  EXPECT_LT(tests::seconds_to_the_machine(page), 3.);
  EXPECT_GE(tests::frames_per_second(page, 3), 30.);
  EXPECT_TRUE(page.errors().empty()) << tests::texts(page.errors());
  EXPECT_TRUE(page.requests().empty()) << tests::texts(page.requests());
  RecordProperty("load_seconds", std::to_string(page.load_seconds()));
}
