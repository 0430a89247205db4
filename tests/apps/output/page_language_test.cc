#include "apps/output/charts/chart.h"
#include "apps/output/report/report.h"
#include "apps/output/text/page_language.h"
#include "tests/support/output_example.h"
#include "tests/support/test.h"

#include <regex>

using namespace gestell::apps;

namespace
{

/// Texts of headings, column heads, captions and the table of contents.
std::vector<std::string> headings(std::string page)
{
  const std::string end = "</script>";
  for (auto at = page.find("<script"); at != std::string::npos; at = page.find("<script", at))
    page.erase(at, page.find(end, at) + end.size() - at);
  static const std::regex  element("<(h2|h3|th|figcaption|a href=\"#)[^>]*>([^<]+)<");
  std::vector<std::string> found;
  for (auto it = std::sregex_iterator(page.begin(), page.end(), element); it != std::sregex_iterator(); ++it)
    found.push_back((*it)[2]);
  return found;
}

/// The page without the texts that are translated.
std::string rest(const std::string &page)
{
  static const std::regex element("(<(h2|h3|th|figcaption|summary|a|span|strong|text|title)[^>]*>)[^<]*"),
      member("\"(title|note|x_label|y_label)\":\"[^\"]*\"");
  return std::regex_replace(std::regex_replace(page, element, "$1"), member, "");
}

std::string german(const std::string &page)
{
  choose_page_language("de");
  return in_page_language(page);
}

} // namespace

struct PageLanguage : ::testing::Test
{
  void TearDown() override { choose_page_language("en"); }
};

TEST_F(PageLanguage, IsEnglishAtFirst)
{
  EXPECT_EQ(in_page_language("<h2>Modes</h2>"), "<h2>Modes</h2>");
}

TEST_F(PageLanguage, TranslatesHeadsAndKeepsUnitsNamesAndSentences)
{
  EXPECT_EQ(german("<h2>Modes</h2><p>Modes</p><td>mode</td>"), "<h2>Eigenformen</h2><p>Modes</p><td>mode</td>");
  EXPECT_EQ(german("<th class=\"n\">phase [deg]</th>"), "<th class=\"n\">Phase [deg]</th>");
  EXPECT_EQ(german("<th>largest range [MPa]</th>"), "<th>größte Schwingbreite [MPa]</th>");
  EXPECT_EQ(german("<summary>12 more charts</summary>"), "<summary>12 weitere Diagramme</summary>");
  EXPECT_EQ(german("<h2>F_P of the slide [N]</h2>"), "<h2>F_P of the slide [N]</h2>");
  EXPECT_EQ(german("<script type=\"application/json\">{\"x_label\":\"frequency [Hz]\",\"y\":\"mode\"}</script>"),
            "<script type=\"application/json\">{\"x_label\":\"Frequenz [Hz]\",\"y\":\"mode\"}</script>");
  EXPECT_EQ(german("<script>const x = '<th>mode</th>';</script>"), "<script>const x = '<th>mode</th>';</script>");
  EXPECT_EQ(german("a < b <th"), "a < b <th");
}

TEST_F(PageLanguage, OfTheReportIsGermanInEachHeadingAndEqualElsewhere)
{
  const std::string english = make_report(example_result()).html;
  choose_page_language("de");
  const std::string page = make_report(example_result()).html;
  EXPECT_EQ(rest(page), rest(english));
  // Only names of signals, symbols, units and words that both languages share are equal.
  const std::vector<std::string> here = headings(page), there = headings(english);
  ASSERT_EQ(here.size(), there.size());
  static const std::regex shared("[^ ]{1,3}( \\[.*\\])?|Newton.*|Amplitude.*");
  for (std::size_t i = 0; i < here.size(); ++i)
    EXPECT_TRUE(here[i] != there[i] || std::regex_match(here[i], shared)) << here[i];
}

TEST_F(PageLanguage, OfChartsIsThatOfPages)
{
  choose_page_language("de");
  Chart chart{"Spectrum"};
  chart.x.label = "frequency [Hz]";
  chart.panels[0].add({"F_P", {0., 1.}, {0., 1.}});
  const std::string svg = chart_svg(chart);
  EXPECT_NE(svg.find(">Spektrum<"), std::string::npos);
  EXPECT_NE(svg.find(">Frequenz [Hz]<"), std::string::npos);
}

TEST_F(PageLanguage, OfUnknownCodeIsRefused)
{
  EXPECT_THROW(choose_page_language("fr"), std::invalid_argument);
}
