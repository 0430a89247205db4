#pragma once

#include "apps/scene/build/build_machine.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

namespace gestell::tests
{

/// Path of a scene of apps/scenes.
inline std::string shipped(const std::string &file)
{
  return std::string(GESTELL_SOURCE_DIR) + "/apps/scenes/" + file;
}

/// A scene of apps/scenes, or any file by its full path, run from beginning to end.
struct SceneRun
{
  explicit SceneRun(const std::string &file, const std::vector<std::string> &overrides = {})
  {
    const apps::Scene scene   = apps::read_scene(file[0] == '/' ? file : shipped(file), overrides);
    coupling::Machine machine = apps::build_machine(scene);
    const auto        signals = apps::scene_signals(scene, machine);
    n                         = machine.size();
    result = coupling::simulate(machine, apps::initial_state(scene, machine), scene.run.options, signals);
  }

  const coupling::SignalSummary &signal(const std::string &name) const
  {
    for (const auto &summary : result.signals)
      if (summary.name == name)
        return summary;
    throw std::invalid_argument("no signal " + name);
  }

  std::size_t n_rows() const { return result.rows.size() / result.columns.size(); }
  double at(std::size_t row, std::size_t column) const { return result.rows[row * result.columns.size() + column]; }

  std::size_t column(const std::string &name) const
  {
    const auto found = std::find(result.columns.begin(), result.columns.end(), name);
    if (found == result.columns.end())
      throw std::invalid_argument("no column " + name);
    return std::size_t(found - result.columns.begin());
  }

  coupling::RunResult result;
  int                 n = 0; ///< coordinates of the machine
};

} // namespace gestell::tests
