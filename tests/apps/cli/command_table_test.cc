// The table of commands: what `gestell --help` and the command line are made from.

#include "apps/cli/commands.h"
#include "apps/reference/questions.h"
#include "tests/support/test.h"

#include <map>
#include <set>
#include <sstream>

using namespace gestell::apps;

TEST(Commands, ReportWhatTheyDoWithAnExampleOfTheirOwn)
{
  std::set<std::string> names;
  for (const Command &command : commands())
  {
    EXPECT_TRUE(names.insert(command.name).second) << command.name << " stands there twice";
    EXPECT_FALSE(command.does.empty()) << command.name;
    ASSERT_FALSE(command.examples.empty()) << command.name;
    for (const std::string &example : command.examples)
      EXPECT_EQ(example.rfind("gestell " + command.name + " ", 0), 0u) << example;
    EXPECT_TRUE(command.run) << command.name;
  }
  EXPECT_TRUE(names.count("run") && names.count("help"));
}

TEST(Commands, HaveOptionsThatNeedWhatStandsBeforeThem)
{
  for (const Command &command : commands())
  {
    std::set<std::string> known;
    for (const CommandOption &option : command.options)
    {
      EXPECT_FALSE(option.does.empty()) << command.name << " " << option.name;
      EXPECT_TRUE(option.needs.empty() || known.count(option.needs)) << command.name << " " << option.name;
      EXPECT_TRUE(known.insert(option.name).second) << command.name << " " << option.name << " stands there twice";
    }
  }
}

TEST(Questions, AreAnsweredByCommandsWithTheirOptions)
{
  std::map<std::string, std::set<std::string>> known;
  for (const Command &command : commands())
  {
    known[command.name];
    for (const CommandOption &option : command.options)
      known[command.name].insert(option.name);
  }
  for (const Question &question : questions())
  {
    std::istringstream words(question.command);
    std::string        name;
    words >> name;
    ASSERT_TRUE(known.count(name)) << question.command;
    for (std::string word; words >> word;)
      EXPECT_TRUE(word.rfind("--", 0) != 0 || known[name].count(word)) << question.command << ": " << word;
  }
}
