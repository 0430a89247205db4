#include "apps/scene/build/build_machine.h"
#include "apps/scene/file/parameters.h"
#include "apps/scene/file/toml_text.h"
#include "apps/scene/scene.h"
#include "tests/support/limited_memory.h"
#include "tests/support/scene_text.h"
#include "tests/support/test.h"

namespace gestell::apps
{
namespace
{

constexpr int n_parameters = 30000; // with a search of each place from the first line on: five minutes

std::string text_of_parameters()
{
  std::string text = "name = \"many\"\n[parameters]\n";
  for (int i = 0; i < n_parameters; ++i)
  {
    const std::string own = "p" + std::to_string(i);
    text += own + " = \"" + (i % 2 == 0 ? "3 mm" : "2 * p" + std::to_string(i - 1)) + "\"\n";
  }
  return text;
}

TEST(LargeScenes, PlacesOfManyEntriesAreFoundInOneReading)
{
  const SceneNode  root  = parse_toml_text(text_of_parameters(), "many.toml", "/");
  const SceneNode *table = root.find("parameters");
  ASSERT_TRUE(table);
  ASSERT_EQ(table->entries.size(), std::size_t(n_parameters));
  EXPECT_EQ(table->place.text(), "many.toml:2");
  for (int i = 0; i < n_parameters; i += 997)
  {
    EXPECT_EQ(table->entries[std::size_t(i)].first, "p" + std::to_string(i)) << "order of the file";
    EXPECT_EQ(table->entries[std::size_t(i)].second.place.line, 3 + i);
  }
}

TEST(LargeScenes, AParameterIsReadWithoutTheNamesOfAllOthers)
{
  const SceneNode  root = parse_toml_text(text_of_parameters(), "many.toml", "/");
  const Parameters parameters(root.find("parameters"));
  EXPECT_DOUBLE_EQ(parameters.find("p" + std::to_string(n_parameters - 1))->value, 6e-3);
  EXPECT_EQ(parameters.names().size(), std::size_t(n_parameters));
}

TEST(LargeScenes, PlacesStandWhereValuesBegin)
{
  const SceneNode  root  = parse_toml_text("a = 1\n"
                                             "\n"
                                             "b.c = [ 1.50,\n"
                                             "  2_0.5,  { d = 3 } ]   # none\n"
                                             "[[e]]\n"
                                             "f = 'x'\n"
                                             "[[e]]\n"
                                             "f = \"\"\"y\n"
                                             "z\"\"\"\n",
                                           "some.toml", "/");
  const SceneNode &array = *root.find("b")->find("c");
  EXPECT_EQ(root.find("a")->place.line, 1);
  EXPECT_EQ(array.place.line, 3);
  EXPECT_EQ(array.elements[0].place.line, 3);
  EXPECT_EQ(array.elements[0].text, "1.50"); // as written
  EXPECT_EQ(array.elements[1].place.line, 4);
  EXPECT_EQ(array.elements[2].find("d")->place.line, 4);
  EXPECT_EQ(root.find("e")->elements[0].find("f")->place.line, 6);
  EXPECT_EQ(root.find("e")->elements[1].find("f")->place.line, 8);
}

/// Point masses in a row, each held to the one before it.
std::string chain_of_masses(int n)
{
  std::string text = "name = \"row\"\n";
  for (int i = 0; i < n; ++i)
  {
    const std::string own = std::to_string(i), from = i == 0 ? "ground" : "m" + std::to_string(i - 1);
    text += "[body.m" + own + "]\ntype = \"point\"\nmass = 1\nposition = [\"" + own + " mm\", 0, 0]\n[element.s" + own +
            "]\ntype = \"spring-damper\"\nfrom = \"" + from + "\"\nto = \"m" + own +
            "\"\ndirection = [1, 0, 0]\nstiffness = 1e6\n";
  }
  return text;
}

/// Nine dense matrices of the 3000 coordinates would be 650 MB; sparse ones have a few numbers in a row.
TEST(LargeScenes, AMachineOfManyMassesIsCheckedInLittleMemory)
{
  const Scene                scene = test::scene_of(chain_of_masses(1000));
  const tests::LimitedMemory limited(std::size_t(100) << 20);
  EXPECT_NO_THROW(check_scene(scene));
}

} // namespace
} // namespace gestell::apps
