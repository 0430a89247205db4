// `gestell new`: scenes to start from.

#include "apps/templates/scene_templates.h"
#include "tests/support/program.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

std::string written_to(const Folder &folder, const std::string &kind)
{
  return "new " + kind + " " + (folder / "my.toml").string();
}

class NewScene : public testing::TestWithParam<const char *>
{
};

// As `gestell new` leaves it, with its frame beside it.
TEST_P(NewScene, RunsAsItIs)
{
  const Folder folder("new");
  expect_answer(gestell(written_to(folder, GetParam())), 0, {"my.toml", "my.geo"});
  const Answer run = gestell("run " + (folder / "my.toml").string() + folder.option());
  EXPECT_EQ(run.exit_code, 0) << run.text;
  EXPECT_NE(read(folder.results() / "summary.json").find("\"scene\": \"my\""), std::string::npos);
  // What a beginner reads is about the mesh at most: nothing in the template itself is doubtful.
  for (std::size_t at = run.text.find("warning: "); at != std::string::npos; at = run.text.find("warning: ", at + 1))
    EXPECT_EQ(run.text.compare(at, 14, "warning: mesh:"), 0) << run.text;
}

INSTANTIATE_TEST_SUITE_P(Kinds, NewScene,
                         testing::Values("frame", "slider-crank", "cam", "press", "crane", "loom",
                                         "vibrating-conveyor"),
                         [](const testing::TestParamInfo<const char *> &kind)
                         {
                           const std::string name = kind.param;
                           return name.substr(0, name.find('-'));
                         });

TEST(NewSceneFile, KindsAreThoseThatAreTested)
{
  EXPECT_EQ(apps::scene_templates().size(), 7u);
}

TEST(NewSceneFile, OverwritesNothing)
{
  const Folder folder("new_twice");
  EXPECT_EQ(gestell(written_to(folder, "cam")).exit_code, 0);
  const std::string before = read(folder / "my.toml");
  expect_answer(gestell(written_to(folder, "press")), 2, {"my.toml already exists"});
  EXPECT_EQ(read(folder / "my.toml"), before);
  std::filesystem::remove(folder / "my.toml");
  expect_answer(gestell(written_to(folder, "press")), 2, {"my.geo already exists"});
}

TEST(NewSceneFile, WhereNothingCanBeWrittenIsAMistakeOfInput)
{
  expect_answer(gestell("new press /proc/my.toml"), 2, {"/proc/my.geo", "gestell new press FOLDER/my.toml"});
}

TEST(NewSceneFile, OfNoSuchKindNamesTheNearest)
{
  expect_answer(gestell("new pres"), 2, {"'pres'", "did you mean 'press'?"});
  expect_answer(gestell("new mill"), 2, {"there is no kind of machine 'mill'", "'loom'", "'vibrating-conveyor'"});
  expect_answer(gestell("new press machine.step"), 2, {"must end in .toml"});
}

} // namespace
} // namespace gestell::tests
