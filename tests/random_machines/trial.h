#pragma once

#include "apps/scene/build/build_machine.h"
#include "tests/random_machines/random_machine.h"

#include <filesystem>
#include <string>
#include <vector>

namespace gestell::tests
{

constexpr double patience = 10.; ///< [s] of CPU time for one run
constexpr double at_rest = 1e-4; ///< of the size that motions have: what is smaller is rest

/// One way to compute a machine's motion.
struct Way
{
  std::string             name;
  coupling::MethodOptions method;
};

/// What one way made of it.
struct Told
{
  std::string         refused; ///< why nothing was computed
  bool                slow = false;
  coupling::RunResult run;
  double              cpu_s = 0.;

  bool   complete() const { return refused.empty() && !slow && run.failure.empty(); }
  int    n_rows() const { return run.columns.empty() ? 0 : int(run.rows.size() / run.columns.size()); }
  int    column(const std::string &name) const;
  double at(int row, int column) const { return run.rows[std::size_t(row) * run.columns.size() + column]; }
};

/// The scene of a machine, read, and computed in any way.
class Trial
{
public:
  /// Writes the scene's files into the folder.
  /// @throws std::invalid_argument if the scene is refused
  Trial(const RandomMachine &machine, const std::filesystem::path &folder);
  /// A scene as a tree, whose files are in the folder.
  Trial(const apps::SceneNode &tree, const std::filesystem::path &folder);

  const apps::Scene            &scene() const { return scene_; }
  const coupling::InitialState &initial() const { return initial_; }
  double                        fastest() const { return fastest_; } ///< [rad/s] mode with closed contacts

  /// A run with so many rows, to the machine's end or another.
  Told run(const coupling::MethodOptions &method, int rows, double end = 0.) const;
  /// The same machine with masses and, if they may, starting values that differ by a relative change of this size, at
  /// random.
  Trial perturbed(double change, std::uint64_t seed, bool start_too) const;

  /// So many fixed steps, whatever the guard says.
  Told forced(const coupling::MethodOptions &method, double steps) const;

private:
  explicit Trial(apps::Scene scene);
  void find_start();
  Told computed(const coupling::RunOptions &options) const;

  apps::Scene            scene_;
  coupling::InitialState initial_;
  double                 fastest_ = 0.;
};

/// The largest of the mean differences of all signals, each relative to the largest value of its kind; a signal that
/// jumps is so compared by area, and the instant of the jump counts by its error.
struct Distance
{
  double      value = 0.;
  std::string signal;
};
Distance distance(const RandomMachine &machine, const Told &a, const Told &b);

/// The whole scene as `gestell run` takes it.
std::string whole_scene(const RandomMachine &machine);

/// Writes scene.toml and what it names into a folder.  @return the scene's path
std::filesystem::path write_scene(const RandomMachine &machine, const std::filesystem::path &folder);

} // namespace gestell::tests
