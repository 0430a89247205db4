#include "apps/analysis/comparison/run_comparison.h"
#include "apps/analysis/comparison/scene_comparison.h"
#include "apps/output/faces/faces_page.h"
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

/// Share of the points of a canvas that something is drawn on.
std::string inked(const std::string &canvas)
{
  return "(canvas => { const { width, height } = canvas;"
         " const pixels = canvas.getContext('2d').getImageData(0, 0, width, height).data; let n = 0;"
         " for (let i = 3; i < pixels.length; i += 4) n += pixels[i] > 0; return n / (width * height); })(" +
         canvas + ")";
}

/// A report with all that makes it long: signals of many kinds, warnings, stresses, a comparison.
Result long_result()
{
  Result            result = with_stress(example_result(1000));
  const std::size_t own    = result.run->columns.size();
  for (int k = 0; k < 40; ++k)
  {
    result.run->columns.push_back("signal " + std::to_string(k));
    result.run->units.push_back(k % 2 == 0 ? "N" : "m");
    result.run->signals.push_back({result.run->columns.back(), result.run->units.back(), -1., 0., 1., 0., 0.});
    result.warnings.push_back("warning " + std::to_string(k) + ": " + std::string(60, 'a') + " " +
                              std::string(240, 'b'));
  }
  std::vector<double> rows;
  for (std::size_t i = 0; i < result.run->rows.size(); i += own)
  {
    rows.insert(rows.end(), result.run->rows.begin() + long(i), result.run->rows.begin() + long(i + own));
    for (int k = 0; k < 40; ++k)
      rows.push_back(std::pow(20., k % 4) * std::sin(50. * result.run->rows[i]));
  }
  result.run->rows = rows;
  for (int k = 0; k < 6; ++k) // many answers
    result.answers.push_back(compared_run_answer(compared_run(*result.run, "other", *result.run)));
  return result;
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
  result.answers.push_back(compared_run_answer(compared_run(*result.run, "other", *result.run)));
  Browser page(written(folder, make_report(result)));
  tests::seconds_to_the_machine(page);
  EXPECT_TRUE(page.errors().empty()) << tests::texts(page.errors());
  const std::string stills = "[...document.querySelectorAll('figure.live > .still')]";
  EXPECT_GE(page.value(stills + ".length").get<int>(), 3);
  EXPECT_EQ(page.value(stills + ".every(e => getComputedStyle(e).display === 'none')"), true);
  EXPECT_EQ(page.value("gestell.charts.every(c => c.colours.series.every(x => /^#/.test(x)))"), true);
}

/// All pictures beside the text are drawn for paper, of several shapes one over the other, and leave the view as it
/// was.
TEST(Page, DrawsThePicturesOfTheMachineForPaper)
{
  GESTELL_NEEDS_BROWSER();
  const tests::Folder folder("page_pictures");
  Result              result = with_stress(example_result(1000));
  result.frame_modes.front().shape.setZero();
  result.modes_at = Eigen::Vector4d(0., 0., 2.6, 0.13);
  result.peak     = PeakState{"F_P", "N", 1e6, 0.2341, Eigen::Vector4d(1e-4, 2e-4, 2., 0.1366)}; // play 0.2 mm
  Browser page(written(folder, make_report(result)));
  tests::seconds_to_the_machine(page);
  EXPECT_EQ(page.value("document.querySelectorAll('.machine-picture').length"), page.value("gestell.pictures.length"));
  page.value("window.dispatchEvent(new Event('beforeprint'))");
  const int n = page.value("gestell.pictures.length").get<int>();
  ASSERT_GE(n, 6);
  for (int i = 0; i < n; ++i)
  {
    const std::string picture = "gestell.pictures[" + std::to_string(i) + "]";
    // The machine is as wide or as high as its picture, but it is no rectangle.
    EXPECT_GT(page.value(inked(picture + ".canvas")).get<double>(), 0.1) << i;
    EXPECT_LT(page.value(inked(picture + ".canvas")).get<double>(), 0.9) << i;
  }
  EXPECT_EQ(page.value("gestell.machine.parts.every(p => p.faces.visible && p.faces.material.colorWrite)"), true);
  EXPECT_EQ(page.value("gestell.machine.show.id"), "motion");
  page.value("gestell.pictures[1].canvas.click()"); // the peak, in the view
  EXPECT_NEAR(page.value("gestell.machine.t").get<double>(), 0.2341, 1e-9);
  EXPECT_TRUE(page.errors().empty()) << tests::texts(page.errors());
}

/// The place of the largest stress is ringed where the camera of the picture sees it: at the last corner of the box,
/// which is behind.
TEST(Page, RingsTheLargestStress)
{
  GESTELL_NEEDS_BROWSER();
  const tests::Folder folder("page_ring");
  Browser             page(written(folder, make_report(with_stress(example_result(1000)))));
  tests::seconds_to_the_machine(page);
  const auto red = page.value(
      "(() => { const picture = gestell.pictures.find(p => p.show.id === 'stress-1'); picture.draw();"
      "  const { width, height } = picture.canvas, at = new THREE.Vector3().fromArray(gestell.machine.parts[0].rest, "
      "21);"
      "  at.project(picture.camera); const x = (1 + at.x) * picture.width, y = (1 - at.y) * picture.height;"
      "  const pixels = picture.canvas.getContext('2d').getImageData(0, 0, width, height).data; let n = 0, far = 0;"
      "  for (let j = 0; j < 2 * picture.height; ++j) for (let i = 0; i < width; ++i) {"
      "    const [r, g, b] = pixels.subarray(4 * (j * width + i), 4 * (j * width + i) + 3);"
      "    if (r > 190 && g < 60 && b < 80) { ++n; far = Math.max(far, Math.hypot(i - x, j - y)); } }"
      "  return [n, far]; })()");
  EXPECT_GT(red[0].get<int>(), 60) << "of some 200 points of a ring of radius 18 and breadth 4";
  EXPECT_LT(red[1].get<double>(), 18. + 4. + 0.05 * 800.)
      << "about the corner, displaced by a twentieth of the machine";
}

TEST(FacesPage, ChoosesTheFaceUnderThePointerAndKeepsAllFacesOfAFineMesh)
{
  GESTELL_NEEDS_BROWSER();
  const tests::Folder folder("page_faces");
  folder.file("page.html", faces_page(chequered(23, 8), "plate.step", "0"));
  Browser page(folder / "page.html");
  EXPECT_TRUE(page.errors().empty()) << tests::texts(page.errors());
  EXPECT_TRUE(page.requests().empty()) << tests::texts(page.requests());
  EXPECT_EQ(page.value("new Set(new Uint32Array(Uint8Array.from(atob(frame.face), c => c.charCodeAt(0)).buffer)).size"),
            529);
  EXPECT_EQ(page.value("document.querySelectorAll('.sides canvas').length"), 8);
  // Seen from above the middle of the plate is the middle of face 12 of 23 in row 12 of 23.
  page.value("new Promise(done => { document.getElementById('turn').scrollIntoView();"
             " [...document.querySelectorAll('#views button')].find(b => b.textContent === 'top').click();"
             " setTimeout(done, 300); })");
  const auto at = tests::place_of(page, "#turn");
  page.drag(at[0] + 0.5 * at[2], at[1] + 0.5 * at[3], at[0] + 0.5 * at[2], at[1] + 0.5 * at[3]);
  EXPECT_EQ(page.value("document.getElementById('head').textContent"), "Face 265");
  for (const int side : {0, 6})
    EXPECT_GT(
        page.value(inked("document.querySelectorAll('.sides canvas')[" + std::to_string(side) + "]")).get<double>(),
        0.05);
}

/// A screen is 1080 pixels high.  Whatever a report has, its answers are open and the others are one click away.
TEST(Page, OfALongReportIsEightScreensWithTheRestFolded)
{
  GESTELL_NEEDS_BROWSER();
  const tests::Folder folder("page_screens");
  const Report        report = make_report(long_result());
  Browser             page(written(folder, report));
  page.resize(1400, 1080);
  tests::seconds_to_the_machine(page);
  EXPECT_LE(page.value("document.documentElement.scrollHeight").get<double>(), 8. * 1080.);
  EXPECT_GE(report.charts.size(), 15u);
  // A warning takes a line until it is opened.
  const auto height = [&](const std::string &of)
  { return page.value(of + ".getBoundingClientRect().height").get<double>(); };
  const std::string warning = "document.querySelector('.warnings details.line')", line = warning + ".firstChild";
  const double      closed = height(line);
  EXPECT_LT(closed, 2. * 16.);
  page.value(warning + ".open = true");
  EXPECT_GT(height(line), 2. * closed);
  EXPECT_GE(page.value("document.querySelectorAll('.warnings li').length").get<int>(), 41) << "none is left out";
  EXPECT_TRUE(page.errors().empty()) << tests::texts(page.errors());
}

/// A link of the contents opens its section, whose charts have their width; for print all are open.
TEST(Page, OpensWhatIsFoldedByALinkAndForPrint)
{
  GESTELL_NEEDS_BROWSER();
  const tests::Folder folder("page_folded");
  Browser             page(written(folder, make_report(example_result(4500))));
  tests::seconds_to_the_machine(page);
  const std::string energy = "document.querySelector('#energy details')";
  EXPECT_EQ(page.value(energy + ".open"), false);
  page.value(
      "new Promise(done => { document.querySelector('nav a[href=\"#energy\"]').click(); setTimeout(done, 200); })");
  EXPECT_EQ(page.value(energy + ".open"), true);
  EXPECT_GT(page.value("document.querySelector('#energy .plot canvas').getBoundingClientRect().width").get<double>(),
            600.);
  const std::string closed = "document.querySelectorAll('details:not([open])').length";
  const int         n      = page.value(closed).get<int>();
  EXPECT_GT(n, 1);
  page.value("window.dispatchEvent(new Event('beforeprint'))");
  EXPECT_EQ(page.value(closed), 0);
  page.value("window.dispatchEvent(new Event('afterprint'))");
  EXPECT_EQ(page.value(closed).get<int>(), n);
}

/// As wide as a telephone: the page does not scroll sideways, folded or not; tables and charts do so in themselves.
TEST(Page, FitsANarrowScreen)
{
  GESTELL_NEEDS_BROWSER();
  const tests::Folder folder("page_narrow");
  Browser             page(written(folder, make_report(long_result())));
  page.resize(420, 900);
  tests::seconds_to_the_machine(page);
  const std::string width = "document.documentElement.scrollWidth";
  EXPECT_LE(page.value(width).get<int>(), 420);
  page.value("document.querySelectorAll('details').forEach(e => { e.open = true; })");
  EXPECT_LE(page.value(width).get<int>(), 420);
}

/// One entry for the halves of a bore, and one for all coaxial bores.
TEST(FacesPage, OffersTheWholeBoreOfAFace)
{
  GESTELL_NEEDS_BROWSER();
  const tests::Folder  folder("page_bores");
  coupling::MeshReport report = chequered(2, 1);
  report.surfaces[0].groups   = {{"this bore", {1, 2}, "cylinder = 1\n"}, {"all bores", {1, 2, 4}, "faces = 3\n"}};
  folder.file("page.html", faces_page(report, "plate.step", "0"));
  Browser page(folder / "page.html");
  page.value("document.querySelector('#faces tr[data-f=\"0\"]').click()");
  const std::string buttons = "[...document.querySelectorAll('#choices button')]";
  EXPECT_EQ(page.value(buttons + ".map(b => b.textContent)"),
            (nlohmann::json{"this face alone", "all 2 faces of this bore: 1, 2", "all 3 faces of all bores: 1, 2, 4"}));
  page.value(buttons + "[1].click()");
  EXPECT_EQ(page.value("document.getElementById('entry').textContent"), "[frame.surface.\"bore 1\"]\ncylinder = 1\n");
  EXPECT_EQ(page.value("document.querySelectorAll('#faces tr.chosen').length"), 2);
  page.value("document.querySelector('#faces tr[data-f=\"2\"]').click()"); // a plane
  EXPECT_EQ(page.value(buttons + ".length"), 0);
  EXPECT_EQ(page.value("document.querySelectorAll('#faces tr.chosen').length"), 1);
  EXPECT_TRUE(page.errors().empty()) << tests::texts(page.errors());
}
