#include "apps/scene/file/parameters.h"
#include "apps/scene/file/toml_text.h"

#include <gtest/gtest.h>

#include <string>

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

} // namespace
} // namespace gestell::apps
