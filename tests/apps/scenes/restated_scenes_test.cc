// The same machine under other names and in another order has the same answers: metamorphic tests of all scenes whose
// frame needs no mesh.

#include "apps/scene/file/scene_file.h"
#include "tests/support/restated_scene.h"
#include "tests/support/scene_run.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using apps::SceneNode;
using Type = SceneNode::Type;

struct ShortRun
{
  std::string name, scene, end;
  /// Of a permuted scene.  Sums in another order differ by rounding, 1e-16 of positions; forces of stiff elements and
  /// of joints see it as 1e-10 of themselves, slip and torque of a motor, small differences of speeds, as up to 1e-8.
  double reordered = 1e-9;
};

void PrintTo(const ShortRun &one, std::ostream *out)
{
  *out << one.name;
}

SceneNode tree_of(const ShortRun &one)
{
  return apps::read_scene_file(shipped(one.scene), {"run.end=" + one.end, "run.newton_tolerance=1e-13"});
}

coupling::RunResult run_of(const SceneNode &tree, const ShortRun &one)
{
  return tests::run_of(tree, shipped(one.scene));
}

/// Relative to the largest value of a signal's unit; of a machine that rests to 1e-6 SI units.
Deviation largest_deviation(const coupling::RunResult &a, const coupling::RunResult &b)
{
  const std::size_t width = a.columns.size();
  if (a.rows.size() != b.rows.size() || a.columns != b.columns)
    return {"other rows or columns", 1.};
  std::map<std::string, double> size;
  for (std::size_t i = 0; i < a.rows.size(); ++i)
    size[a.units[i % width]] = std::max(size[a.units[i % width]], std::abs(a.rows[i]));
  for (auto &[unit, largest] : size)
    largest = std::max(largest, 1e-6);
  Deviation worst;
  for (std::size_t column = 0; column <= a.signals.size(); ++column)
    for (std::size_t i = column; i < a.rows.size(); i += width)
      if (const double off = std::abs(a.rows[i] - b.rows[i]) / size[a.units[column]]; off > worst.value)
        worst = {a.columns[column], off};
  return worst;
}

// --- other names

class NewNames
{
public:
  explicit NewNames(const SceneNode &scene)
  {
    std::set<std::string> parameters, names;
    if (const SceneNode *table = scene.find("parameters"))
      for (const auto &entry : table->entries)
        parameters.insert(entry.first);
    for (const std::string &kind : named_tables())
      if (const SceneNode *table = scene.find(kind))
        for (const auto &entry : table->entries)
          if (parameters.count(entry.first) == 0) // a value of that text would be the parameter's
            names.insert(entry.first);
    // In the alphabet the last comes first.
    int left = int(names.size());
    for (const std::string &name : names)
      renamed_[name] = std::string(1, char('a' + left / 26)) + char('a' + left % 26) + " of " + name.substr(0, 2),
      --left;
  }

  /// The text with a name that it begins with, or is, replaced; a minus may stand before it.
  std::string replaced(const std::string &text) const
  {
    const std::size_t begin = text.rfind('-', 0) == 0 ? 1 : 0;
    const auto        ends  = [&](std::size_t end)
    { return end == text.size() || text[end] == '.' || text.compare(end, 11, " unbalance.") == 0; };
    for (const auto &[name, to] : renamed_)
      if (text.compare(begin, name.size(), name) == 0 && ends(begin + name.size()))
        return text.substr(0, begin) + to + text.substr(begin + name.size());
    return text;
  }

  SceneNode of(SceneNode scene) const
  {
    for (const std::string &kind : named_tables())
      if (SceneNode *table = scene.find(kind))
        replace_keys(*table);
    for (const char *state : {"start", "modes"})
      if (SceneNode *table = scene.find(state))
        for (auto &entry : table->entries)
          if (entry.second.type == Type::table)
            replace_keys(entry.second);
    for (auto &[key, value] : scene.entries)
      if (key != "name" && key != "description" && key != "parameters")
        replace_values(value);
    return scene;
  }

private:
  void replace_keys(SceneNode &table) const
  {
    for (auto &entry : table.entries)
      entry.first = replaced(entry.first);
  }

  void replace_values(SceneNode &value) const
  {
    if (value.type == Type::text)
      value.text = replaced(value.text);
    for (SceneNode &element : value.elements)
      replace_values(element);
    for (auto &[key, entry] : value.entries)
      if (key != "type" && key != "material" && key != "method" && key != "rule")
        replace_values(entry);
  }

  std::map<std::string, std::string> renamed_;
};

using RestatedScene = ::testing::TestWithParam<ShortRun>;

// A name takes part in no number.
TEST_P(RestatedScene, UnderOtherNamesIsTheSameToTheBit)
{
  const SceneNode tree     = tree_of(GetParam());
  const auto      original = run_of(tree, GetParam()), renamed = run_of(NewNames(tree).of(tree), GetParam());
  ASSERT_EQ(original.failure, "");
  EXPECT_EQ(original.rows, renamed.rows);
  ASSERT_EQ(original.events.size(), renamed.events.size());
  for (std::size_t i = 0; i < original.events.size(); ++i)
    EXPECT_EQ(original.events[i].t, renamed.events[i].t);
  for (std::size_t i = 0; i < original.signals.size(); ++i)
  {
    EXPECT_EQ(original.signals[i].max, renamed.signals[i].max) << original.signals[i].name;
    EXPECT_EQ(original.signals[i].t_min, renamed.signals[i].t_min) << original.signals[i].name;
  }
}

TEST_P(RestatedScene, InAnotherOrderIsTheSameButForRounding)
{
  const SceneNode tree     = tree_of(GetParam());
  const auto      original = run_of(tree, GetParam());
  for (const unsigned seed : {1u, 2u})
  {
    const auto other = run_of(reordered(tree, seed), GetParam());
    EXPECT_EQ(original.events.size(), other.events.size());
    const Deviation worst = largest_deviation(original, other);
    EXPECT_LE(worst.value, GetParam().reordered) << worst.signal << " of seed " << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(Shipped, RestatedScene,
                         ::testing::Values(ShortRun{"cam_follower", "cam_follower.toml", "20 ms"},
                                           ShortRun{"crane", "crane_minimal.toml", "0.2 s"},
                                           ShortRun{"crane_lift", "crane_minimal_lift.toml", "0.1 s"},
                                           ShortRun{"crane_elastic", "crane_minimal_elastic.toml", "0.1 s"},
                                           ShortRun{"crank_press", "crank_press_joints.toml", "50 ms", 3e-8},
                                           ShortRun{"double_four_bar", "double_four_bar.toml", "0.5 s"},
                                           ShortRun{"geneva_drive", "geneva_drive.toml", "0.4 s"},
                                           ShortRun{"offset_four_bar", "offset_four_bar.toml", "0.5 s"},
                                           ShortRun{"press", "press_minimal.toml", "20 ms", 3e-8},
                                           ShortRun{"press_light", "press_minimal_light.toml", "20 ms", 3e-8},
                                           ShortRun{"press_stop", "press_emergency_stop.toml", "20 ms"},
                                           ShortRun{"press_strokes", "press_strokes.toml", "50 ms", 3e-8},
                                           ShortRun{"run_up", "run_up.toml", "0.1 s"},
                                           ShortRun{"journal", "slider_crank_journal.toml", "5 ms"},
                                           ShortRun{"spatial", "spatial_crank_rocker.toml", "0.5 s"},
                                           ShortRun{"masses", "benchmark/m20.toml", "10 ms"}),
                         [](const auto &info) { return info.param.name; });

} // namespace
} // namespace gestell::tests
