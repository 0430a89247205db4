#include "apps/analysis/comparison/run_comparison.h"
#include "apps/analysis/comparison/scene_comparison.h"
#include "apps/output/faces/faces_page.h"
#include "apps/output/interactive/page_scripts.h"
#include "apps/output/report/report.h"
#include "apps/output/report/stress_report.h"
#include "apps/output/tables/summary_json.h"
#include "tests/support/output_example.h"
#include "tests/support/test.h"

#include <regex>

using namespace gestell::apps;

namespace
{

/// Name of the first element that is closed wrongly or never; empty if the markup is sound.
std::string unbalanced(const std::string &markup)
{
  static const std::set<std::string> empty_elements = {"meta", "!DOCTYPE"};

  std::vector<std::string> open;
  for (std::size_t i = markup.find('<'); i != std::string::npos; i = markup.find('<', i))
  {
    std::size_t end = i + 1;
    for (bool quoted = false; end < markup.size() && (quoted || markup[end] != '>'); ++end)
      quoted = markup[end] == '"' ? !quoted : quoted;
    const bool        closes = markup[i + 1] == '/';
    const std::size_t first  = i + (closes ? 2 : 1);
    const std::string name   = markup.substr(first, markup.find_first_of(" />\n", first) - first);
    const bool        whole  = markup[end - 1] == '/' || empty_elements.count(name) > 0;
    i                        = end;
    if (whole)
      continue;
    if (!closes)
      open.push_back(name);
    else if (open.empty() || open.back() != name)
      return name;
    else
      open.pop_back();
  }
  return open.empty() ? "" : open.back();
}

std::string without(std::string text, const std::string &part)
{
  for (std::size_t i = text.find(part); i != std::string::npos; i = text.find(part))
    text.erase(i, part.size());
  return text;
}

/// The page as it stands where no script runs: browsers judge the scripts, see tests/apps/pages.
std::string without_scripts(std::string html)
{
  const std::string end = "</script>";
  for (auto at = html.find("<script"); at != std::string::npos; at = html.find("<script", at))
    html.erase(at, html.find(end, at) + end.size() - at);
  return html;
}

bool holds(const std::string &text, const std::string &part)
{
  return text.find(part) != std::string::npos;
}

} // namespace

TEST(Report, IsSoundMarkupAndSoAreItsPictures)
{
  const Report report = make_report(example_result());
  EXPECT_EQ(unbalanced(without_scripts(report.html)), "");
  EXPECT_EQ(unbalanced("<p><b></p></b>"), "p");
  std::set<std::string> names;
  for (const auto &[name, svg] : report.charts)
  {
    EXPECT_EQ(unbalanced(svg), "") << name;
    EXPECT_TRUE(names.insert(name).second) << name;
  }
  for (const char *name : {"forces", "forces-shock", "displacements", "energy", "mode-coupled-1"})
    EXPECT_EQ(names.count(name), 1u) << name;
}

TEST(Report, NeedsNothingFromOutside)
{
  const std::string whole = make_report(example_result()).html;
  const std::string html  = without(without_scripts(whole), "xmlns=\"http://www.w3.org/2000/svg\"");
  for (const char *reference : {"http:", "https:", "src=", "url(", "@import", "<link"})
    EXPECT_EQ(html.find(reference), std::string::npos) << reference;
  EXPECT_EQ(whole.find("<script src"), std::string::npos);
}

TEST(Report, WarnsFirstThenAnswersThenExplains)
{
  const std::string html    = make_report(example_result()).html;
  std::size_t       reached = 0;
  for (const char *text : {"press &quot;example&quot; &lt;1&gt;", "The mesh is coarse.", "1056.6", "id=\"forces\"",
                           "id=\"motion\"", "id=\"events\"", "id=\"energy\"", "id=\"modes\"", "id=\"numerics\""})
  {
    ASSERT_NE(html.find(text), std::string::npos) << text;
    EXPECT_GT(html.find(text), reached) << text;
    reached = html.find(text);
  }
}

TEST(Report, StatesTheEnergyResidualAsShareOfWhatTheMotionExchanges)
{
  // 0.5 J of 2200 J
  EXPECT_NE(make_report(example_result()).html.find("0.5 J</strong>, <strong>0.023 %"), std::string::npos);
}

TEST(Report, LeavesOutWhatWasNotComputed)
{
  Result result = example_result();
  result.run.reset();
  result.scenery = Scenery();
  result.warnings.clear();
  result.scenery.n_frame = 2;
  const Report report    = make_report(result);
  EXPECT_EQ(unbalanced(without_scripts(report.html)), "");
  for (const char *absent : {"Warnings", "id=\"peaks\"", "id=\"forces\"", "id=\"events\"", "id=\"energy\""})
    EXPECT_EQ(report.html.find(absent), std::string::npos) << absent;
  EXPECT_NE(report.html.find("id=\"modes\""), std::string::npos);
}

TEST(Report, TellsInTwoSentencesWhatWasComputedBeforeItWarns)
{
  Result result          = example_result();
  result.run->method     = "BDF 2";
  const std::string html = make_report(result).html;
  const std::string said = html.substr(html.find("id=\"computed\""), 600);
  for (const char *part : {"from 0 to 0.45 s was computed by BDF 2 in 45000 steps with 4 DOFs",
                           "F_P reaches 1057 kN at 0.2341 s", "3 events occurred", "energy residual is 0.023 %"})
    EXPECT_NE(said.find(part), std::string::npos) << part << "\n" << said;
  EXPECT_LT(html.find("id=\"computed\""), html.find("The mesh is coarse."));
}

TEST(Report, ShowsNoiseAsZeroAndTurnsPerMinuteBesideRadiansPerSecond)
{
  Result result = example_result();
  result.run->signals.push_back({"F_hl", "N", -1.4e-10, 0.1, 3e3, 0.2, 1.});
  result.run->signals.push_back({"omega", "rad/s", 0., 0., 10. * M_PI, 0.4, 10. * M_PI});
  const std::string html = without_scripts(make_report(result).html);
  std::smatch       small;
  EXPECT_FALSE(std::regex_search(html, small, std::regex("[0-9]e-1[0-9]"))) << small.str();
  const auto row = html.substr(html.find("<td>1/min</td>"), 80);
  EXPECT_NE(row.find(">300<"), std::string::npos) << row;
}

TEST(Report, NamesTheLibrariesItCarriesAndKeepsTheirLicence)
{
  const std::string html = make_report(example_result()).html;
  for (const PageLibrary &library : page_libraries())
    EXPECT_NE(html.find("page library: " + library.name), std::string::npos);
  EXPECT_FALSE(page_libraries().empty()) << "install libjs-dygraphs and libjs-three";
  EXPECT_NE(html.find("The above copyright notice and this permission notice"), std::string::npos);
}

/// Of many compared signals a page keeps few pictures; a line names the file of each other one, and the file is there.
TEST(Report, NamesTheFilesOfComparedSignalsBeyondTheFirst)
{
  Result result = example_result();
  result.run->signals.clear();
  for (std::size_t j = 1; j < result.run->columns.size(); ++j)
    result.run->signals.push_back({result.run->columns[j], result.run->units[j], -1., 0., 1., 0., 0.});
  result.answers.push_back(compared_run_answer(compared_run(*result.run, "other", *result.run)));
  const Report      report  = make_report(result);
  const std::size_t begin   = report.html.find("<section id=\"compared-run\"");
  const std::string section = report.html.substr(begin, report.html.find("</section>", begin) - begin);
  std::size_t       copies = 0, named = 0;
  for (const auto &[name, svg] : report.charts)
    if (name.rfind("compared-", 0) == 0)
    {
      const bool is_named = section.find(": charts/" + name + ".svg</p>") != std::string::npos;
      named += is_named ? 1 : 0;
      copies += section.find(svg) != std::string::npos ? 1 : 0;
      EXPECT_EQ(is_named, section.find(svg) == std::string::npos) << name;
    }
  EXPECT_EQ(copies, page_libraries().empty() ? copies : 4u);
  EXPECT_GE(copies + named, 7u);
}

TEST(Report, OfModesAloneShowsTheMechanism)
{
  Result result = example_result();
  result.run.reset();
  result.modes_at        = Eigen::Vector4d(0., 0., 2.6, 0.13);
  const std::string html = make_report(result).html;
  EXPECT_NE(html.find("Mechanism seen through the frame, in the configuration of the modes."), std::string::npos);
  EXPECT_NE(html.find("\"name\":\"crank\""), std::string::npos); // a part of the view
  EXPECT_NE(html.find("data-show=\"rest\""), std::string::npos);
  EXPECT_NE(html.find("\"id\":\"rest\""), std::string::npos);
}

/// What a figure names, the view has: what both write by themselves must not part.
TEST(Report, NamesPicturesThatItsViewHas)
{
  Result result = with_stress(example_result());
  result.frame_modes.resize(5, result.frame_modes.front());
  result.modes_at         = Eigen::Vector4d(0., 0., 2.6, 0.13);
  result.peak             = PeakState{"F_P", "N", 1e6, 0.2341, Eigen::Vector4d(0., 1e-4, 2., 0.1)};
  const std::string html  = make_report(result).html;
  std::size_t       n     = 0;
  const std::string begin = "data-show=\"";
  for (std::size_t at = html.find(begin); at != std::string::npos; at = html.find(begin, at + 1), ++n)
  {
    const std::size_t first = at + begin.size();
    const std::string show  = html.substr(first, html.find('"', first) - first);
    EXPECT_NE(html.find("\"id\":\"" + show + "\""), std::string::npos) << show;
  }
  EXPECT_EQ(n, 2u + result.coupled_modes.size() + 5u + 1u); // the start and the peak, modes, an instant of stress
}

TEST(StressOutput, IsInTheSummaryOnlyWhereItWasAskedFor)
{
  const Result result = with_stress(example_result());
  const auto   json   = summary_json(result);
  EXPECT_TRUE(holds(json, "\"label\": \"largest F_P\""));
  EXPECT_TRUE(holds(json, "\"beside\": \"support feet\""));
  EXPECT_FALSE(holds(summary_json(example_result()), "\"stress\""));
  EXPECT_FALSE(holds(make_report(example_result()).html, "id=\"stress\""));
}

TEST(StressOutput, TellsBothPlacesAndTheDoubtInTheReport)
{
  const Report report = make_report(with_stress(example_result()));
  EXPECT_TRUE(holds(report.html, "<section id=\"stress\""));
  EXPECT_TRUE(holds(report.html, "href=\"#stress\""));
  EXPECT_TRUE(holds(report.html, ">support feet<"));
  EXPECT_TRUE(holds(report.html, "largest F_P"));
  EXPECT_TRUE(holds(report.html, "<th class=\"n\">disagreement of elements"));
  EXPECT_TRUE(holds(report.html, "too coarse")) << "the disagreement is above 10 %";
  EXPECT_TRUE(holds(report.html, "data-show=\"stress-1\"")) << "a picture of the instant";
  EXPECT_TRUE(holds(report.html, "\"mark\":7")) << "the peak, at the last corner, is ringed";
  EXPECT_TRUE(holds(report.html, "stress 0 to 80 MPa")) << "colours end at the largest value away from rigid surfaces";
}

TEST(FacesPage, HoldsFiveHundredFacesOfAFineMeshInFiveMegabytes)
{
  const std::string page = faces_page(chequered(23, 8), "plate.step", "0"); // 529 faces, 67 712 triangles
  EXPECT_LT(page.size(), 5000000u);
  EXPECT_NE(page.find("529 faces"), std::string::npos);
  EXPECT_NE(page.find("\"tag\":529"), std::string::npos);
}

TEST(FacesPage, GivesLengthsInTheUnitOfTheFileAndInMetres)
{
  const std::string page = faces_page(chequered(2, 1), "plate.step", "0");
  EXPECT_NE(page.find("250000 mm² = 0.25 m²"), std::string::npos);
  EXPECT_NE(page.find("(1000, 1000, 0) mm = (1, 1, 0) m"), std::string::npos);
}

TEST(FacesPage, IsNotBrokenByANameThatEndsAScript)
{
  coupling::MeshReport report = chequered(2, 1);
  const auto           ends   = [&]
  {
    const std::string page = faces_page(report, "plate.step", "0");
    std::size_t       n    = 0;
    for (std::size_t at = page.find("</script>"); at != std::string::npos; at = page.find("</script>", at + 1))
      ++n;
    return n;
  };
  const std::size_t with_it = ends();
  ASSERT_EQ(std::exchange(report.surfaces[3].name, ""), "</script>");
  EXPECT_EQ(with_it, ends());
}

/// "<!--<script>" would let the page's end tag end nothing.
TEST(FacesPage, IsNotBrokenByANameThatOpensAComment)
{
  coupling::MeshReport report = chequered(2, 1);
  report.surfaces[0].name     = "<!--<script>";
  const std::string page      = faces_page(report, "plate.step", "0");
  const std::size_t data      = page.find("const frame = ");
  ASSERT_NE(data, std::string::npos);
  EXPECT_EQ(page.substr(data, page.find('\n', data) - data).find('<'), std::string::npos);
}
