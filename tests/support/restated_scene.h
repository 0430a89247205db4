#pragma once

#include "apps/scene/file/scene_node.h"
#include "coupling/simulation/run_result.h"

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace gestell::tests
{

/// A signal of a scene by those of another one: offset + sum of weight times signal, by their names in output.signals.
struct SignalSum
{
  double                                      offset = 0.;
  std::vector<std::pair<double, std::string>> terms;
};

/**
 * The same machine in other words: seen from elsewhere, in another order, under other names, in other units.
 *
 * Its answers follow from those of the original: a metamorphic test needs no reference.  To add a restatement, write a
 * function that changes the tree of a scene (read_scene_file()) and tells how each signal of the original follows from
 * the new ones; signals that it leaves out of the map are not compared.
 */
struct Restated
{
  apps::SceneNode                  scene;
  std::map<std::string, SignalSum> signals; ///< by the original's names
};
using Restatement = std::function<Restated(const apps::SceneNode &)>;

/// Tables of things that have names.
const std::vector<std::string> &named_tables();

/// Another order, at random, of tables in the file, of things in them and of values in [start].  Measures stay: one may
/// name those above it alone.
apps::SceneNode reordered(apps::SceneNode scene, unsigned seed);

/// The tree with the resultant of each joint that has one among its signals, under the name "|JOINT|".
apps::SceneNode with_resultants(apps::SceneNode scene);

/// The run of a tree, wherever it stops, without pictures.
/// @param path  that the scene has in messages
coupling::RunResult run_of(const apps::SceneNode &scene, const std::string &path);

/// The signal that differs most, relative to its largest value; of a sum relative to the largest length of its terms.
struct Deviation
{
  std::string signal;
  double      value = 0.;
};
/// @throws std::runtime_error if the two have other rows or miss a signal
Deviation largest_deviation(const coupling::RunResult &original, const coupling::RunResult &restated,
                            const std::map<std::string, SignalSum> &signals);

} // namespace gestell::tests
