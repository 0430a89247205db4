// What every analysis declares, and sections that page and terminal have alike.

#include "apps/analysis/analyses.h"
#include "apps/output/report/section.h"
#include "apps/output/tables/summary_json.h"
#include "tests/support/refusal.h"
#include "tests/support/test.h"

namespace gestell::apps
{
namespace
{

using ::testing::HasSubstr;

TEST(Analyses, DeclareOptionsThatExplainThemselves)
{
  std::set<std::string> names;
  for (const AnalysisEntry &entry : analyses())
  {
    EXPECT_TRUE(entry.is_command() || !entry.of.empty()) << entry.name << " can be asked for by nothing";
    for (const CommandOption &option : entry.begin()->options())
    {
      EXPECT_EQ(option.name.substr(0, 2), "--") << entry.name;
      EXPECT_FALSE(option.does.empty()) << option.name;
      for (const std::string &command : {entry.is_command() ? entry.name : "", entry.of})
        EXPECT_TRUE(command.empty() || names.insert(command + ' ' + option.name).second) << option.name << " twice";
    }
  }
  EXPECT_GT(names.size(), 10u);
}

TEST(Analyses, AreFoundByTheirNames)
{
  EXPECT_EQ(analysis_named("frf").name, "frf");
  EXPECT_THAT(tests::refusal([] { analysis_named("frt"); }), HasSubstr("frf"));
}

TEST(CommandOption, IsSetFromTexts)
{
  int                      count = 1;
  double                   size  = 0.;
  bool                     is    = false;
  std::vector<std::string> names;
  CommandOption{"--count", &count, ""}.set({"12"});
  CommandOption{"--size", &size, ""}.set({"2.5e-3"});
  CommandOption{"--is", &is, ""}.set({"True"});
  CommandOption{"--names", &names, ""}.set({"a", "b"});
  EXPECT_EQ(count, 12);
  EXPECT_EQ(size, 2.5e-3);
  EXPECT_TRUE(is);
  EXPECT_EQ(names, (std::vector<std::string>{"a", "b"}));
  CommandOption{"--is", &is, ""}.set({"False"});
  EXPECT_FALSE(is);
}

TEST(CommandOption, RefusesTextsThatAreNoneOfItsKind)
{
  int         count   = 1;
  std::string kind    = "one";
  const auto  refused = [](const CommandOption &option, const std::string &text)
  { return tests::refusal([&] { option.set({text}); }); };
  EXPECT_THAT(refused({"--count", &count, ""}, "1.5"), HasSubstr("--count: needs an integer, got '1.5'"));
  EXPECT_THAT(refused({"--count", &count, ""}, "many"), HasSubstr("got 'many'"));
  EXPECT_THAT(refused(CommandOption{"--kind", &kind, ""}.one_of({"one", "two"}), "tow"), HasSubstr("two"));
  EXPECT_EQ(count, 1);
  EXPECT_EQ(kind, "one");
}

/// An answer of one section.
class Shown : public Answer
{
public:
  explicit Shown(const Section &section) : section_(section) {}

  void                 describe(JsonMembers &) const override {}
  void                 describe(SchemaMembers &) const override {}
  std::vector<Section> sections(const Result &) const override { return {section_}; }

private:
  Section section_;
};

TEST(Section, HasItsSentencesAndTablesOnThePageAndInATerminal)
{
  HtmlTable both({"part <a>", "#range"}), drawn({"#x"});
  both.add({"rod <1>", "12.5"});
  both.add_note("a note over all columns");
  drawn.add({"77"});
  Section section{"life", "Life", "Life"};
  section.parts = {Section::Sentences{"Cycles < 100 count."}, both, Section::Sentences{"Rings: peaks.", true},
                   Section::PageTable{drawn}, Section::Picture{"life", "<svg></svg>"}};

  Pictures          pictures;
  const std::string html = section_html(section, pictures);
  EXPECT_EQ(pictures, (Pictures{{"life", "<svg></svg>"}}));
  for (const char *text : {"<section id=\"life\"><details open><summary><h2>Life</h2>", "Cycles &lt; 100 count.",
                           "rod &lt;1&gt;", "12.5", "a note over all columns", "Rings: peaks.", ">77<", "<svg></svg>"})
    EXPECT_THAT(html, HasSubstr(text));

  Result result;
  result.answers.push_back(std::make_shared<Shown>(section));
  EXPECT_EQ(answers_text(result), "Life\nCycles < 100 count.\n"
                                  "  part <a>  range\n"
                                  "  rod <1>    12.5\n"
                                  "  a note over all columns\n");
  Chart narrow;
  narrow.width = 372.;
  const Section::Drawing picture{"narrow", narrow, ChartLink::none, Section::Drawing::Shown::picture};
  EXPECT_THAT(section_html({"pair", "", "", {}, false, {picture, picture}}, pictures), HasSubstr("class=\"row\""));
  section.page = true;
  Result of_page;
  of_page.answers.push_back(std::make_shared<Shown>(section));
  EXPECT_EQ(answers_text(of_page), "");
  EXPECT_EQ(section_html({"life", "Life", "Life"}, pictures), "");
}

} // namespace
} // namespace gestell::apps
