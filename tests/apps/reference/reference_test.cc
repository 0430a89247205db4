// What is declared of the scene language is what readers ask for, and what help, schema and docs say.

#include "apps/reference/declared_tables.h"
#include "apps/reference/help_text.h"
#include "apps/reference/json_schema.h"
#include "apps/reference/key_tables.h"
#include "apps/reference/synonyms.h"
#include "apps/scene/bodies/body_types.h"
#include "apps/scene/elements/element_types.h"
#include "apps/scene/file/scene_file.h"
#include "apps/scene/scene.h"
#include "tests/support/refusal.h"
#include "tests/support/scene_text.h"
#include "tests/support/test.h"

namespace
{

using namespace gestell::apps;
using gestell::test::SceneFolder;
using gestell::test::with;

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
void take_asked(const SceneNode &table, const std::vector<Key> &keys, const std::string &path, Keys &requested)
{
  for (const std::string &key : table.requested)
    requested.insert(path + key);
  for (const Key &key : keys)
    if (const SceneNode *value = table.find(key.name); value && !key.keys.empty())
    {
      take_asked(*value, key.keys, path + key.name + ".", requested);
      for (const SceneNode &element : value->elements)
        take_asked(element, key.keys, path + key.name + ".", requested);
    }
}

/// Keys that the reader of a type asks for in an example.
void take_asked_for(const ElementType &type, const std::string &example, Keys &requested)
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
  take_asked(*root.find("element")->find("it"), type.keys, "", requested);
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

std::vector<std::string> documents()
{
  std::vector<std::string> files;
  for (const auto &entry : std::filesystem::recursive_directory_iterator(GESTELL_SOURCE_DIR "/docs/reference"))
    if (entry.path().extension() == ".md")
      files.push_back(std::filesystem::relative(entry.path(), GESTELL_SOURCE_DIR).string());
  return files;
}

/// Tables of a scene below a heading, "[frame.surface.NAME]", "[[life.weld]]".
std::vector<const SceneNode *> tables_below(const SceneNode &root, const std::string &heading)
{
  std::vector<const SceneNode *> found{&root};
  const std::size_t              begin = std::min(heading.find_first_not_of('['), heading.size());
  std::stringstream              path(heading.substr(begin, heading.size() - 2 * begin));
  for (std::string part; std::getline(path, part, '.');)
  {
    std::vector<const SceneNode *> next;
    for (const SceneNode *node : found)
      for (const auto &[key, value] : node->entries)
        if (part == "NAME" || part == key)
        {
          if (value.type == SceneNode::Type::table)
            next.push_back(&value);
          for (const SceneNode &element : value.elements)
            if (element.type == SceneNode::Type::table)
              next.push_back(&element);
        }
    found = next;
  }
  return found;
}

/// What readers asked all scenes for, by the path of the declared table: "joint.gear", "joint.gear ratio".
struct LookedUp
{
  std::map<std::string, Keys> of_table, of_heading, inner;

  void take(const SceneNode &root)
  {
    for (const DeclaredTable &table : declared_tables())
      if (table.heading.empty() || table.heading.front() == '[')
        for (const SceneNode *node : tables_below(root, table.heading))
        {
          of_heading[table.heading].insert(node->requested.begin(), node->requested.end());
          const SceneNode *type = node->find("type");
          if (!table.type.empty() && !(type && type->text == table.type))
            continue;
          of_table[table.path].insert(node->requested.begin(), node->requested.end());
          Keys all;
          take_asked(*node, table.keys, "", all);
          for (const std::string &key : all)
            if (key.find('.') != std::string::npos)
              inner[table.heading].insert(key);
        }
  }
};

/// Matrices and a node as Nastran writes them.
const std::string cards = "GRID,1,,0.,0.,0.\n"
                          "DMIG,KAAX,0,6,2\nDMIG,KAAX,1,3,,1,3,2.\n"
                          "DMIG,MAAX,0,6,2\nDMIG,MAAX,1,3,,1,3,1.\n"
                          "DMIG,BAAX,0,6,2\nDMIG,BAAX,1,3,,1,3,0.1\n";

/// Reads a scene beside files "frame.step" and "frame.pch"; what it says against it, and what was asked.
std::string read(const std::string &text, LookedUp &requested)
{
  const SceneFolder folder;
  folder.write("frame.step", "no geometry");
  folder.write("frame.pch", cards);
  const std::string file  = folder.write("scene.toml", text);
  const SceneNode   root  = read_scene_file(file, {});
  const std::string error = gestell::tests::refusal([&] { read_scene(root, file, gestell::fem::Scripts::harmless); });
  requested.take(root);
  return error;
}

/// A body whose shape is in a file that cannot be read.
std::string body_from_cad(const std::string &type)
{
  const std::string direction = type == "planar"                      ? "normal = [0, 1, 0]\n"
                                : type == "rotor" || type == "slider" ? "axis = [0, 1, 0]\n"
                                                                      : "";
  return "[body.part]\ntype = \"" + type + "\"\n" + direction +
         "cad = \"frame.step\"\nmaterial = \"steel\"\nplacement = { axis = [0, 1, 0], angle = \"30 deg\" }\n";
}

const LookedUp &all_asked()
{
  static const LookedUp requested = []
  {
    LookedUp everything;
    EXPECT_EQ(read(content("tests/apps/reference/machine.toml"), everything), "");
    EXPECT_EQ(read(content("tests/apps/reference/frame_from_cad.toml"), everything), "");
    const std::string parts = content("tests/apps/reference/frame_of_parts.toml");
    EXPECT_EQ(read(parts, everything), "");
    EXPECT_EQ(
        read(with(parts, "rayleigh = [{ frequency = '20 Hz', ratio = 0.01 }, { frequency = '500 Hz', ratio = 0.02 }]",
                  "modes = [{ mode = 1, ratio = 0.01 }]"),
             everything),
        "");
    EXPECT_EQ(read(content("tests/apps/reference/imported_frame.toml"), everything), "");
    for (const BodyType &type : body_types())
      EXPECT_NE(read(body_from_cad(type.name), everything), "") << type.name;
    return everything;
  }();
  return requested;
}

/// Those of `wanted` that `known` has not.
Keys missing(const Keys &wanted, const Keys &known)
{
  Keys found;
  std::set_difference(wanted.begin(), wanted.end(), known.begin(), known.end(), std::inserter(found, found.end()));
  return found;
}

const Keys &at(const std::map<std::string, Keys> &requested, const std::string &path)
{
  static const Keys none;
  const auto        found = requested.find(path);
  return found == requested.end() ? none : found->second;
}

bool is_element(const DeclaredTable &table)
{
  return table.heading == "[element.NAME]";
}

} // namespace

TEST(Elements, AskForEveryKeyTheyDeclareAndForNoOther)
{
  Keys inner_declared, inner_asked; // of all types: keys of ramps and of friction are the same for many
  for (const ElementType &type : element_types())
  {
    Keys requested;
    for (const std::string &example : type.examples)
      take_asked_for(type, example, requested);
    for (auto key = requested.begin(); key != requested.end();)
      if (key->find('.') != std::string::npos)
      {
        inner_asked.insert(*key);
        key = requested.erase(key);
      }
      else
        ++key;
    EXPECT_EQ(requested, names_of(joined({common_element_keys(), type.keys}))) << type.name;
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

TEST(Declarations, ReportWhatEveryKeyMeansOnce)
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

TEST(Tables, AreAskedForEveryKeyTheyDeclare)
{
  for (const DeclaredTable &table : declared_tables())
    if (!is_element(table) && (table.heading.empty() || table.heading.front() == '['))
    {
      EXPECT_EQ(missing(names_of(table.keys), at(all_asked().of_table, table.path)), Keys()) << table.path;
      Keys inner;
      take_inner(table.keys, "", inner);
      EXPECT_EQ(missing(inner, at(all_asked().inner, table.heading)), Keys()) << table.path;
    }
}

TEST(Tables, DeclareEveryKeyTheyAreAskedFor)
{
  std::map<std::string, Keys> declared;
  for (const DeclaredTable &table : declared_tables())
    for (const Key &key : table.keys)
      declared[table.heading].insert(key.name);
  for (const auto &[heading, requested] : all_asked().of_heading)
    EXPECT_EQ(missing(requested, declared[heading]), Keys()) << heading;
}

TEST(Documents, AreWhatTheDeclarationsGive)
{
  std::string all;
  for (const std::string &document : documents())
  {
    EXPECT_EQ(content(document), renewed(content(document))) << "renew it: gestell help --renew docs";
    all += content(document);
  }
  EXPECT_EQ(content("docs/scene.schema.json"), json_schema()) << "renew it: gestell help --renew docs";
  for (const DeclaredTable &table : declared_tables())
  {
    const std::string family = table.type.empty() ? table.path : table.path.substr(0, table.path.find('.'));
    EXPECT_NE(all.find("<!-- keys: " + family + " -->"), std::string::npos) << table.path << " is in no document";
  }
}

TEST(Help, AnswersToWordsOfTheWorkshop)
{
  std::set<std::string> paths;
  for (const DeclaredTable &table : declared_tables())
    paths.insert(table.path);
  for (const Synonym &synonym : synonyms())
    for (const std::string &path : synonym.tables)
    {
      EXPECT_EQ(paths.count(path), 1u) << synonym.word << ": " << path;
      EXPECT_NE(help_text(synonym.word).find("  " + path + ' '), std::string::npos) << synonym.word << ": " << path;
    }
  for (const char *word : {"belt", "bearing", "ram", "gib", "spindle"})
    EXPECT_NE(help_text(word), "");
  gestell::tests::expect_refusal([] { help_text("spindel"); }, "spindle");
}

TEST(Help, FindsTablesAndKeysAndSuggestsNearOnes)
{
  EXPECT_NE(help_text("").find("gestell size SCENE"), std::string::npos);
  EXPECT_NE(help_text("what force").find("gestell run SCENE"), std::string::npos);
  EXPECT_NE(help_text("which frequency").find("gestell modes SCENE"), std::string::npos);
  EXPECT_NE(help_text("How much model").find("gestell size SCENE"), std::string::npos);
  EXPECT_NE(help_text("how exact").find("gestell run SCENE --budget"), std::string::npos);
  EXPECT_NE(help_text("").find("element.rope"), std::string::npos);
  EXPECT_NE(help_text("element.rope").find("slack"), std::string::npos);
  EXPECT_EQ(help_text("rope"), help_text("element.rope"));
  EXPECT_NE(help_text("element.rope.slack").find("becomes taut"), std::string::npos);
  EXPECT_NE(help_text("stiffness").find("element.spring-damper"), std::string::npos);
  EXPECT_NE(help_text("run.method").find("generalised-alpha"), std::string::npos);
  EXPECT_NE(help_text("joint").find("joint.prismatic"), std::string::npos);
  EXPECT_NE(help_text("frame").find("frame.surface"), std::string::npos);
  gestell::tests::expect_refusal([&] { help_text("element.roop"); }, "element.rope");
}

void expect_known(const std::string &path, const std::vector<Key> &keys)
{
  for (const Key &key : keys)
  {
    const std::string own = path + '.' + key.name;
    for (std::size_t dot = 0; dot != std::string::npos; dot = own.find('.', dot + 1))
    {
      const std::string topic = own.substr(dot == 0 ? 0 : dot + 1);
      EXPECT_NE(help_text(topic).find(key.name), std::string::npos) << topic;
    }
    expect_known(own, key.keys);
  }
}

/// Inside inline tables, too, and by the last parts of the path; a name of a table and of keys gives both.
TEST(Help, KnowsEveryKey)
{
  for (const DeclaredTable &table : declared_tables())
    if (!table.path.empty())
      expect_known(table.path, table.keys);
  EXPECT_NE(help_text("prestress.loads").find("frame.prestress\n  loads"), std::string::npos);
  EXPECT_NE(help_text("damping.modes").find(help_text("frame.damping.modes")), std::string::npos);
  for (const char *path : {"frame.damping.ratio", "life.weld.curve.class", "curve.class"})
    EXPECT_NE(help_text(path), "");
  const std::string modes = help_text("modes");
  for (const char *path : {"[modes]", "  reduction.modes ", "  frame.damping.modes "})
    EXPECT_NE(modes.find(path), std::string::npos) << path;
  gestell::tests::expect_refusal([&] { help_text("damping.rato"); }, "damping.ratio");
}
