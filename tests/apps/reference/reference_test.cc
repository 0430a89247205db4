// What is declared of the scene language is what readers ask for, and what help, schema and docs say.

#include "apps/reference/declared_tables.h"
#include "apps/reference/help_text.h"
#include "apps/reference/json_schema.h"
#include "apps/reference/key_tables.h"
#include "apps/scene/elements/element_types.h"
#include "apps/scene/file/scene_file.h"
#include "apps/scene/read/read_bodies.h"
#include "tests/support/scene_text.h"

#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>

namespace
{

using namespace gestell::apps;
using gestell::test::SceneFolder;

/// What the examples act on.
const std::string bodies = R"toml(
[body.crank]
type    = "rotor"
axis    = [0, 1, 0]
inertia = "250 kg m^2"
[body.flywheel]
type    = "rotor"
axis    = [0, 1, 0]
inertia = "100 kg m^2"
[body.slide]
type = "slider"
axis = [0, 0, -1]
mass = "3 t"
[body.spindle]
type     = "point"
mass     = "20 kg"
position = [0, 0, 0]
[body.lance]
type     = "rigid"
mass     = "20 kg"
inertia  = [1, 1, 1]
position = [0, 0, 0]
)toml";

using Keys = std::set<std::string>;

/// Keys that readers asked a table for, and the tables of its keys: "friction", "friction.static".
void take_asked(const SceneNode &table, const std::vector<Key> &keys, const std::string &path, Keys &asked)
{
  for (const std::string &key : table.asked)
    asked.insert(path + key);
  for (const Key &key : keys)
    if (const SceneNode *value = table.find(key.name); value && !key.keys.empty())
    {
      take_asked(*value, key.keys, path + key.name + ".", asked);
      for (const SceneNode &element : value->elements)
        take_asked(element, key.keys, path + key.name + ".", asked);
    }
}

/// Keys that the reader of a type asks for in an example.
void take_asked_for(const ElementType &type, const std::string &example, Keys &asked)
{
  const SceneFolder folder;
  const SceneNode   root = read_scene_file(
        folder.write("scene.toml", bodies + "[element.it]\ntype = \"" + type.name + "\"\n" + example), {});
  const Parameters parameters(nullptr);
  const SceneTable table(root, parameters, "");
  Names            names({}, false);
  Scene            scene;
  scene.bodies = read_bodies(table, names, gestell::fem::Scripts::harmless);
  EXPECT_NO_THROW(read_elements(table, names, scene)) << type.name << "\n" << example;
  EXPECT_NO_THROW(table.table("element").finish()) << type.name << ": no example has a key without a reader";
  take_asked(*root.find("element")->find("it"), type.keys, "", asked);
}

Keys names_of(const std::vector<Key> &keys)
{
  Keys names;
  for (const Key &key : keys)
    names.insert(key.name);
  return names;
}

/// "friction.static" and the like.
void take_inner(const std::vector<Key> &keys, const std::string &path, Keys &inner)
{
  for (const Key &key : keys)
  {
    if (!path.empty())
      inner.insert(path + key.name);
    take_inner(key.keys, path + key.name + ".", inner);
  }
}

std::string content(const std::string &file)
{
  std::ifstream     in(std::string(GESTELL_SOURCE_DIR) + "/" + file);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

/// Between the markers of generated text.
std::string generated(const std::string &document)
{
  const std::string begin = "<!-- gestell help --tables -->\n", end = "<!-- end -->";
  const auto        from = document.find(begin), to = document.find(end);
  return from == std::string::npos || to == std::string::npos
             ? ""
             : document.substr(from + begin.size(), to - from - begin.size());
}

} // namespace

TEST(Elements, AskForEveryKeyTheyDeclareAndForNoOther)
{
  Keys inner_declared, inner_asked; // of all types: keys of ramps and of friction are the same for many
  for (const ElementType &type : element_types())
  {
    Keys asked;
    for (const std::string &example : type.examples)
      take_asked_for(type, example, asked);
    for (auto key = asked.begin(); key != asked.end();)
      if (key->find('.') != std::string::npos)
      {
        inner_asked.insert(*key);
        key = asked.erase(key);
      }
      else
        ++key;
    EXPECT_EQ(asked, names_of(joined({common_element_keys(), type.keys}))) << type.name;
    take_inner(type.keys, "", inner_declared);
  }
  EXPECT_EQ(inner_asked, inner_declared);
}

TEST(Elements, RefuseToReadWhatIsNotDeclared)
{
  const SceneFolder      folder;
  const SceneNode        root = read_scene_file(folder.write("scene.toml", "mass = 3\nlength = 2\n"), {});
  const Parameters       parameters(nullptr);
  const std::vector<Key> keys  = {key::number("mass", kind::mass, "of it").above_zero()};
  const SceneTable       table = SceneTable(root, parameters, "").declared(keys);
  EXPECT_EQ(table.value("mass"), 3.);
  EXPECT_THROW(table.has("length"), std::logic_error);
}

TEST(Declarations, TellWhatEveryKeyMeansOnce)
{
  for (const DeclaredTable &table : declared_tables())
  {
    std::set<std::string> names;
    for (const Key &key : table.keys)
    {
      EXPECT_FALSE(key.meaning.empty()) << table.path << "." << key.name;
      EXPECT_TRUE(names.insert(key.name).second) << table.path << "." << key.name << " is declared twice";
    }
  }
}

TEST(Documents, AreWhatTheDeclarationsGive)
{
  EXPECT_EQ(generated(content("docs/scene/elements.md")), key_tables())
      << "write it anew: gestell help --tables, between the markers";
  EXPECT_EQ(content("docs/scene.schema.json"), json_schema())
      << "write it anew: gestell help --schema > docs/scene.schema.json";
}

TEST(Help, FindsTablesAndKeysAndSuggestsNearOnes)
{
  EXPECT_NE(help_text("").find("element.rope"), std::string::npos);
  EXPECT_NE(help_text("element.rope").find("slack"), std::string::npos);
  EXPECT_EQ(help_text("rope"), help_text("element.rope"));
  EXPECT_NE(help_text("element.rope.slack").find("becomes taut"), std::string::npos);
  EXPECT_NE(help_text("stiffness").find("element.spring-damper"), std::string::npos);
  try
  {
    help_text("element.roop");
    FAIL() << "no such table";
  }
  catch (const std::invalid_argument &error)
  {
    EXPECT_NE(std::string(error.what()).find("element.rope"), std::string::npos) << error.what();
  }
}
