#include "tests/support/restated_scene.h"

#include "apps/scene/build/build_machine.h"
#include "apps/scene/scene.h"
#include "tests/support/node_values.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <utility>

namespace gestell::tests
{

using apps::SceneNode;

const std::vector<std::string> &named_tables()
{
  static const std::vector<std::string> kinds{"body", "place", "measure", "element", "joint", "switch"};
  return kinds;
}

SceneNode reordered(SceneNode scene, unsigned seed)
{
  std::mt19937 dice(seed);
  const auto   shuffle = [&](SceneNode &table)
  {
    for (std::size_t i = table.entries.size(); i > 1; --i) // std::shuffle differs between libraries
      std::swap(table.entries[i - 1], table.entries[dice() % i]);
  };
  for (const std::string &kind : named_tables())
    if (SceneNode *table = scene.find(kind); table && kind != "measure")
      shuffle(*table);
  if (SceneNode *start = scene.find("start"))
    for (auto &entry : start->entries)
      if (entry.second.type == SceneNode::Type::table)
        shuffle(entry.second);
  shuffle(scene);
  return scene;
}

SceneNode with_resultants(SceneNode scene)
{
  const std::vector<std::string> with{"revolute", "spherical", "universal", "cylindrical", "rigid", "prismatic"};
  std::vector<std::string>       names;
  if (const SceneNode *joints = scene.find("joint"))
    for (const auto &[name, joint] : joints->entries)
      if (std::find(with.begin(), with.end(), joint.find("type")->text) != with.end())
        names.push_back(name);
  SceneNode &signals = table_of(table_of(scene, "output"), "signals");
  for (const std::string &name : names)
    signals.entries.emplace_back("|" + name + "|", text_node(name + ".resultant"));
  return scene;
}

coupling::RunResult run_of(const SceneNode &tree, const std::string &path)
{
  SceneNode  without_pictures = tree;
  SceneNode &output           = table_of(without_pictures, "output");
  output.entries.erase(std::remove_if(output.entries.begin(), output.entries.end(),
                                      [](const auto &entry) { return entry.first == "picture_step"; }),
                       output.entries.end());
  output.entries.emplace_back("picture_step", number_node(0.));
  const apps::Scene scene   = apps::read_scene(without_pictures, path, fem::Scripts::harmless);
  coupling::Machine machine = apps::build_machine(scene);
  const auto        signals = apps::scene_signals(scene, machine);
  return coupling::simulate(machine, apps::initial_state(scene, machine), scene.run.options, signals);
}

namespace
{

/// Histories of a run by name.
class Histories
{
public:
  explicit Histories(const coupling::RunResult &run) : run_(run) {}

  std::size_t n_rows() const { return run_.rows.size() / run_.columns.size(); }
  double      at(std::size_t row, const std::string &name) const
  {
    const auto found = std::find(run_.columns.begin(), run_.columns.end(), name);
    if (found == run_.columns.end())
      throw std::runtime_error("no signal " + name);
    return run_.rows[row * run_.columns.size() + std::size_t(found - run_.columns.begin())];
  }

private:
  const coupling::RunResult &run_;
};

} // namespace

Deviation largest_deviation(const coupling::RunResult &original, const coupling::RunResult &restated,
                            const std::map<std::string, SignalSum> &signals)
{
  const Histories a(original), b(restated);
  if (a.n_rows() != b.n_rows())
    throw std::runtime_error("histories of " + std::to_string(a.n_rows()) + " and " + std::to_string(b.n_rows()) +
                             " rows");
  Deviation worst;
  for (const auto &[name, sum] : signals)
  {
    double size = 0., largest = 0.;
    for (std::size_t row = 0; row < a.n_rows(); ++row)
    {
      double value = sum.offset, square = 0.;
      for (const auto &[weight, of] : sum.terms)
      {
        const double y = b.at(row, of);
        value += weight * y;
        square += y * y;
      }
      size    = std::max({size, std::sqrt(square), std::abs(a.at(row, name))});
      largest = std::max(largest, std::abs(value - a.at(row, name)));
    }
    if (size > 0. && !(largest / size <= worst.value))
      worst = {name, largest / size};
  }
  return worst;
}

} // namespace gestell::tests
