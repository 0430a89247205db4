#include "apps/output/report/report.h"
#include "tests/apps/pages/page_measures.h"
#include "tests/support/output_example.h"
#include "tests/support/program.h"

using namespace gestell;
using namespace gestell::apps;
using tests::Browser;

namespace
{

std::filesystem::path written(const tests::Folder &folder, const Report &report)
{
  folder.file("page.html", report.html);
  return folder / "page.html";
}

constexpr const char *windows = "gestell.charts.filter(c => c.data.link === 'time').map(c => c.graph.xAxisRange())";

} // namespace

TEST(Page, OpensWithoutErrorsAndAsksForNothingElse)
{
  GESTELL_NEEDS_BROWSER();
  const tests::Folder folder("page_opens");
  Browser             page(written(folder, make_report(with_stress(example_result(4500)))));
  tests::seconds_to_the_machine(page);
  EXPECT_TRUE(page.errors().empty()) << tests::texts(page.errors());
  EXPECT_TRUE(page.requests().empty()) << tests::texts(page.requests());
  EXPECT_GE(page.value("gestell.charts.length").get<int>(), 4);
  EXPECT_EQ(page.value("document.querySelectorAll('figure.live:not(.drawn)').length"), 0);
}

TEST(Page, ZoomsAllChartsOverTheTimeByADragAndShowsAllAgainByAKey)
{
  GESTELL_NEEDS_BROWSER();
  const tests::Folder folder("page_zooms");
  Browser             page(written(folder, make_report(example_result(4500))));
  const auto          whole = page.value(windows);
  const auto          at    = tests::place_of(page, "figure.live .plot");
  page.drag(at[0] + 0.4 * at[2], at[1] + 0.5 * at[3], at[0] + 0.6 * at[2], at[1] + 0.5 * at[3]);
  const auto zoomed = page.value(windows);
  ASSERT_GE(zoomed.size(), 3u);
  for (const auto &window : zoomed)
  {
    EXPECT_LT(window[1].get<double>() - window[0].get<double>(), 0.3 * 0.45);
    EXPECT_EQ(window, zoomed[0]);
  }
  page.value("document.querySelector('figure.live .plot').focus()");
  page.press_key("0");
  EXPECT_EQ(page.value(windows), whole);
}

TEST(Page, ReadsThePeakAtTheCursorInEveryChartOfTheTime)
{
  GESTELL_NEEDS_BROWSER();
  const tests::Folder folder("page_reads");
  Browser             page(written(folder, make_report(example_result(4500))));
  tests::seconds_to_the_machine(page);
  page.value("gestell.charts[0].point_at(0.239)");
  // The push that ends at 0.24 s, told from the rows kept of each thousandth of it: 0.3 kN by their straight lines.
  const std::string legend = page.value("gestell.charts[0].legend.textContent");
  ASSERT_EQ(legend.find("F_P "), 0u) << legend;
  EXPECT_NEAR(std::stod(legend.substr(4)), 1e3 * std::sin(M_PI / 2. * 0.049 / 0.05), 0.3) << legend;
  EXPECT_NE(legend.find("at t = 0.239 s"), std::string::npos) << legend;
  EXPECT_EQ(page.value("gestell.charts.every(c => !c.data.link || c.x === 0.239)"), true);
  EXPECT_NEAR(page.value("gestell.machine.t").get<double>(), 0.239, 1e-9);
}

TEST(Page, HidesACurveByItsName)
{
  GESTELL_NEEDS_BROWSER();
  const tests::Folder folder("page_hides");
  Browser             page(written(folder, make_report(example_result(1000))));
  page.value("document.querySelector('.chart-legend button').click()");
  EXPECT_EQ(page.value("gestell.charts[0].graph.visibility()[0]"), false);
  EXPECT_EQ(page.value("document.querySelector('.chart-legend button').getAttribute('aria-pressed')"), "false");
}

/// The lift of the box at 0.2 s is the second coordinate of the picture there, 0.2 mm, enlarged.
TEST(Page, PutsTheFrameWhereItsCoordinatesSay)
{
  GESTELL_NEEDS_BROWSER();
  const tests::Folder folder("page_frame");
  Browser             page(written(folder, make_report(example_result(1000))));
  tests::seconds_to_the_machine(page);
  const auto lift = page.value("(() => { const v = gestell.machine; v.go_to(0.2); v.draw();"
                               " return (v.parts[0].at[2] - v.parts[0].rest[2]) / v.enlarge; })()");
  EXPECT_NEAR(lift.get<double>(), 2e-4, 1e-6);
}

TEST(Page, ShowsModesAndStressesOfItsList)
{
  GESTELL_NEEDS_BROWSER();
  const tests::Folder folder("page_list");
  Browser             page(written(folder, make_report(with_stress(example_result(1000)))));
  tests::seconds_to_the_machine(page);
  EXPECT_EQ(page.value("gestell.machine.shows.map(s => s.kind)"),
            (nlohmann::json{"motion", "mode", "mode", "mode", "stress"}));
  for (int i = 0; i < 5; ++i)
    page.value("new Promise(done => { gestell.machine.choose(" + std::to_string(i) + "); setTimeout(done, 100); })");
  EXPECT_TRUE(page.errors().empty()) << tests::texts(page.errors());
  // The most stressed corner is the last one, in the last colour.
  EXPECT_EQ(page.value("gestell.machine.show.paints[7]"), 255);
}

/// The lines of charts without a picture have the colours of those with one, and the line that names their file is
/// for paper.
TEST(Page, DrawsComparedSignalsWithoutAPictureOfTheirOwn)
{
  GESTELL_NEEDS_BROWSER();
  const tests::Folder folder("page_compared");
  Result              result = example_result(1000);
  result.run->signals.clear();
  for (std::size_t j = 1; j < result.run->columns.size(); ++j)
    result.run->signals.push_back({result.run->columns[j], result.run->units[j], -1., 0., 1., 0., 0.});
  result.compared_run = ComparedRun{"other", *result.run};
  Browser page(written(folder, make_report(result)));
  tests::seconds_to_the_machine(page);
  EXPECT_TRUE(page.errors().empty()) << tests::texts(page.errors());
  const std::string stills = "[...document.querySelectorAll('figure.live > .still')]";
  EXPECT_GE(page.value(stills + ".length").get<int>(), 3);
  EXPECT_EQ(page.value(stills + ".every(e => getComputedStyle(e).display === 'none')"), true);
  EXPECT_EQ(page.value("gestell.charts.every(c => c.colours.series.every(x => /^#/.test(x)))"), true);
}
