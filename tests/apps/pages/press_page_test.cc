#include "tests/apps/pages/page_measures.h"
#include "tests/support/program.h"

using namespace gestell;
using tests::Browser;

/// What the page of the press on its frame of finite elements costs a reader, in numbers that no other load of the machine
/// changes: its bytes, the triangles of a picture, what it asks for.  tests/benchmarks/page_benchmark.cc measures its pace.
TEST(PressPage, IsBelow5MBAndMovesByPicturesOfFewTriangles)
{
  GESTELL_NEEDS_BROWSER();
  const tests::Folder folder("press_page");
  tests::expect_answer(tests::gestell("run " + tests::scene("press.toml") + folder.option()), 0, {});
  const auto report = folder.results() / "report.html";
  EXPECT_LT(std::filesystem::file_size(report), 5000000u);

  Browser page(report);
  tests::seconds_to_the_machine(page);
  const auto moved = page.value("new Promise(done => { const first = gestell.machine.frames;"
                                "  document.querySelector('.machine').scrollIntoView();"
                                "  gestell.machine.set_playing(true);"
                                "  const look = () => gestell.machine.frames > first + 2"
                                "    ? done([gestell.machine.t, gestell.machine.renderer.info.render.triangles])"
                                "    : setTimeout(look, 10);"
                                "  look(); })");
  EXPECT_GT(moved[0].get<double>(), 0.);
  EXPECT_GT(moved[1].get<int>(), 1000);
  EXPECT_LT(moved[1].get<int>(), 20000); // 6500 of the frame, 3000 of each body at most
  EXPECT_TRUE(page.errors().empty()) << tests::texts(page.errors());
  EXPECT_TRUE(page.requests().empty()) << tests::texts(page.requests());
}

TEST(PressPage, BesideAnotherPressIsBelow5MB)
{
  const tests::Folder folder("press_page_compared");
  tests::expect_answer(tests::gestell("run " + tests::scene("press.toml") + " --compare " +
                                      tests::scene("press_minimal_light.toml") + folder.option()),
                       0, {});
  EXPECT_LT(std::filesystem::file_size(folder.results() / "report.html"), 5000000u);
}
