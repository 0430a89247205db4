// The table of commands: what `gestell --help` and the command line are made from.

#include "apps/cli/commands.h"
#include "tests/support/test.h"

using namespace gestell::apps;

TEST(Commands, TellWhatTheyDoWithAnExampleOfTheirOwn)
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
