#include "tests/random_machines/other_units.h"

#include "apps/scene/file/scene_file.h"
#include "tests/random_machines/dice.h"
#include "tests/random_machines/trial.h"
#include "tests/support/node_values.h"
#include "tests/support/rescaled_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace gestell::tests
{
namespace
{

constexpr int    rows_of_units = 2000, fixed_steps_of_units = 2000;
constexpr double same_motion = 1e-10; ///< of the largest value of a signal
constexpr double few_digits  = 10. * std::numeric_limits<double>::epsilon();

/// The rows of a MatrixMarket file, symmetric.
apps::SceneNode rows_of(const std::string &market)
{
  std::istringstream text(market);
  std::string        head;
  std::getline(text, head);
  std::size_t n = 0, count = 0, i = 0, k = 0;
  text >> n >> n >> count;
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(Eigen::Index(n), Eigen::Index(n));
  for (double value = 0.; text >> i >> k >> value;)
    A(Eigen::Index(i) - 1, Eigen::Index(k) - 1) = A(Eigen::Index(k) - 1, Eigen::Index(i) - 1) = value;
  std::vector<apps::SceneNode> rows;
  for (Eigen::Index row = 0; row < A.rows(); ++row)
  {
    std::vector<apps::SceneNode> entries;
    for (Eigen::Index column = 0; column < A.cols(); ++column)
      entries.push_back(number_node(A(row, column)));
    rows.push_back(array_node(entries));
  }
  return array_node(rows);
}

/// The scene, with matrices instead of files.
apps::SceneNode tree_of(const RandomMachine &machine, const std::filesystem::path &folder)
{
  apps::SceneNode tree = apps::read_scene_file(write_scene(machine, folder).string(), {});
  if (apps::SceneNode *frame = tree.find("frame"))
    for (auto &entry : frame->entries)
      if (const auto file = machine.files.find(entry.second.text); file != machine.files.end())
      {
        apps::SceneNode rows = rows_of(file->second);
        put_at(rows, entry.second);
        entry.second = rows;
      }
  return tree;
}

UnitPowers drawn_units(std::uint64_t seed)
{
  Dice       dice(seed ^ 0x756e697473u); // of its own: the machine of a seed stays what it is
  const auto power  = [&dice] { return 2 * dice.whole(13) - 12; };
  const int  length = power(), mass = power();
  return {length, mass, power()};
}

/// Signals in the units that the machine was described in.
void restore(Told &reported, const UnitPowers &powers)
{
  coupling::RunResult &run   = reported.run;
  const std::size_t    width = run.columns.size();
  for (std::size_t i = 0; i < run.rows.size(); ++i)
    run.rows[i] /= growth(powers, run.units[i % width]);
}

class UnitsJudge
{
public:
  UnitsJudge(const RandomMachine &machine, const std::filesystem::path &folder)
      : machine_(machine), powers_(drawn_units(machine.seed)), original_(tree_of(machine, folder), folder),
        other_(rescaled(tree_of(machine, folder), powers_).scene, folder)
  {
  }

  Verdict verdict()
  {
    coupling::MethodOptions bdf;
    bdf.method    = "bdf";
    bdf.order     = 5;
    bdf.tolerance = 1e-8;
    compare({"bdf 1e-8", bdf});
    coupling::MethodOptions second;
    const bool              exact = !machine_.bdf_only && !machine_.jointed && !machine_.accelerated;
    second.method                 = exact ? "exact" : "bdf";
    second.order                  = exact ? 4 : 2;
    second.tolerance              = exact ? 1e-8 : 0.;
    second.step                   = exact ? 0. : machine_.end / fixed_steps_of_units;
    compare({exact ? "exact 1e-8" : "bdf 2 fixed", second});
    return verdict_;
  }

private:
  void compare(const Way &way)
  {
    Way there = way;
    there.method.step *= growth(powers_, "s");
    const Told here     = run(original_, way);
    Told       reported = run(other_, there);
    if (here.slow || reported.slow)
      return; // judge() says so
    std::ostringstream units;
    units << way.name << " in units 2^(" << powers_[0] << ", " << powers_[1] << ", " << powers_[2] << ")";
    const std::string failure       = here.refused + here.run.failure,
                      failure_there = reported.refused + reported.run.failure;
    if (failure.empty() != failure_there.empty())
      verdict_.findings.push_back({"fails in one system of units", units.str(), failure + failure_there});
    if (!here.complete() || !reported.complete())
      return;
    restore(reported, powers_);
    const Distance apart = distance(machine_, here, reported);
    if (apart.value <= same_motion)
      return;
    double bound = same_motion + 10. * known_to(here, way);
    // Where rounding turns a decision, such as whether a step is short enough, both are as near as the tolerance says.
    const auto &a = here.run.work, &b = reported.run.work;
    if (apart.value > bound && way.method.tolerance > 0. && (a.steps != b.steps || a.newton != b.newton))
      bound += 10. * self_distance(here, way);
    if (apart.value > bound)
      verdict_.findings.push_back({"differs in other units", units.str(), apart.signal, apart.value, bound});
  }

  /// What rounding of masses and starting values makes of the motion.
  double known_to(const Told &reported, const Way &way)
  {
    double largest = 0.;
    for (std::uint64_t draw = 1; draw <= 3; ++draw)
      if (const Told noisy = run(original_.perturbed(few_digits, machine_.seed + draw, !machine_.closed_start), way);
          noisy.complete())
        largest = std::max(largest, distance(machine_, reported, noisy).value);
    return largest;
  }

  double self_distance(const Told &reported, Way way)
  {
    way.method.tolerance /= 10.;
    const Told finer = run(original_, way);
    return finer.complete() ? distance(machine_, reported, finer).value : 0.;
  }

  Told run(const Trial &trial, const Way &way)
  {
    Told reported = trial.run(way.method, rows_of_units);
    verdict_.cpu_s += reported.cpu_s;
    return reported;
  }

  const RandomMachine &machine_;
  UnitPowers           powers_;
  Trial                original_, other_;
  Verdict              verdict_;
};

} // namespace

Verdict judge_in_other_units(const RandomMachine &machine, const std::filesystem::path &folder)
{
  try
  {
    return UnitsJudge(machine, folder).verdict();
  }
  catch (const std::exception &refusal)
  {
    return {{{"refused", "in other units", refusal.what()}}};
  }
}

} // namespace gestell::tests
