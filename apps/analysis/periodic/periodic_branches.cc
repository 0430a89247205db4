#include "apps/analysis/periodic/periodic_branches.h"

#include "apps/analysis/periodic/periodic_entry.h"
#include "apps/scene/build/build_machine.h"
#include "coupling/periodic/periodic_methods.h"
#include "coupling/periodic/verified_orbit.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>

namespace gestell::apps
{

namespace
{
/// points at which branches leave that are followed: each branch costs as much as the first
constexpr std::size_t most_left = 16;

using coupling::PeriodicSolution;

std::unique_ptr<coupling::BranchEquations> equations_for(const SceneFamily &family, const PeriodicSolution &first,
                                                         const coupling::PeriodicOptions &options, int repeats)
{
  return coupling::branch_from(first, family.problems(), options, repeats);
}

/// The branches that leave at a special motion, of `repeats` periods; at a doubling after twice as many.
std::vector<coupling::Branch> new_branches(const SceneFamily &family, coupling::SpecialMotion special,
                                           const coupling::PeriodicOptions     &options,
                                           const coupling::ContinuationOptions &along, int repeats,
                                           const coupling::BranchProgress &progress)
{
  if (special.kind == "period doubling")
  {
    special.solution.period *= 2.;
    special.solution.turn *= 2.;
  }
  const auto equations = equations_for(family, special.solution, options, repeats);
  return follow_new_branches(*equations, special, along, progress);
}

/// Whether a solution is on a branch that has been followed already.
bool known(const PeriodicResult &result, const PeriodicSolution &solution, double parameter, double range)
{
  const double omega = 2. * M_PI / solution.period, size = omega * solution.q.norm() + solution.v.norm();
  return std::any_of(result.entries.begin(), result.entries.end(),
                     [&](const PeriodicEntry &entry)
                     {
                       const PeriodicSolution &s    = entry.solution;
                       constexpr double        same = 1e-5; // distance of two motions, of their size
                       return std::abs(entry.parameter - parameter) <= 1e-12 * range && s.ratio == solution.ratio &&
                              omega * (s.q - solution.q).norm() + (s.v - solution.v).norm() <= same * size;
                     });
}

/// Points at which branches left that are followed already: branches meet each other at both their ends.
class LeftBranches
{
public:
  explicit LeftBranches(double range) : range_(range) {}

  bool full() const { return points_.size() >= most_left; }
  /// Whether none left there before; it does from now on.
  bool is_new(const coupling::SpecialMotion &special)
  {
    constexpr double same_place = 1e-6; // of the range, of the period: to where special points are located
    for (const coupling::SpecialMotion &known : points_)
      if (known.kind == special.kind && std::abs(known.parameter - special.parameter) <= same_place * range_ &&
          std::abs(known.solution.period - special.solution.period) <= same_place * known.solution.period)
        return false;
    points_.push_back(special);
    return true;
  }

private:
  double                               range_;
  std::vector<coupling::SpecialMotion> points_;
};

/// Why a branch ended; if the frequency of a load becomes zero just beyond its last solution, this is the reason.
std::string end_of(const coupling::Branch &branch, const SceneFamily &family, double step)
{
  if (!branch.failed)
    return branch.ended;
  const double last = branch.points.back().parameter;
  for (const double beyond : {last + step, last - step})
    if (const std::string why = family.standstill(last, beyond); !why.empty())
      return why + " (" + branch.ended + ")";
  return branch.ended;
}

/// Writes a branch into the result, with the signals of every point.
class BranchTable
{
public:
  BranchTable(const SceneFamily &family, PeriodicResult &result) : family_(family), result_(result) {}

  void add(coupling::Branch branch)
  {
    verify_branch(family_.problems(), branch);
    ++number_;
    const std::size_t first = result_.entries.size();
    for (const coupling::BranchPoint &point : branch.points)
      add_point(point);
    for (const coupling::SpecialMotion &special : branch.special)
      result_.special_points.push_back(
          {special.kind, special.parameter, special.solution.period, int(first) + special.nearest + 1});
  }

private:
  void add_point(const coupling::BranchPoint &point)
  {
    const auto                member  = family_.member(point.parameter);
    const auto                signals = scene_signals(*member->scene, member->prepared->machine);
    coupling::PeriodicProblem problem = member->problem;
    problem.period                    = point.solution.period;
    problem.ratio                     = point.solution.ratio;
    constexpr int rows_of_branches    = 128; // of a period: extremes to (pi / 128)^2 / 2 = 0.03 %
    PeriodicEntry entry = entry_of(member->prepared->machine, problem, point.solution, signals, rows_of_branches);
    entry.branch        = number_;
    entry.parameter     = point.parameter;
    result_.entries.push_back(std::move(entry));
  }

  const SceneFamily &family_;
  PeriodicResult    &result_;
  int                number_ = 0;
};

} // namespace

void follow_branches(const SceneFamily &family, const std::vector<PeriodicSolution> &solutions,
                     const coupling::PeriodicOptions &options, const PeriodicRequest &request,
                     const std::function<void(double)> &progress, const std::atomic<bool> *stop, PeriodicResult &result)
{
  coupling::ContinuationOptions along;
  along.from                         = family.from();
  along.to                           = family.to();
  constexpr int usual_points         = 100; // of a curve: a step of 1 % of the range
  along.points                       = request.points > 0 ? request.points : usual_points;
  constexpr int most_turns_per_point = 10; // points of a branch, of those from end to end
  along.most                         = std::max(along.most, most_turns_per_point * along.points);
  along.tolerance                    = std::max(along.tolerance, options.tolerance);
  BranchTable table(family, result);
  const auto  on_point = [&](const coupling::BranchPoint &point)
  {
    progress((point.parameter - along.from) / (along.to - along.from));
    return !(stop && stop->load(std::memory_order_relaxed));
  };
  const auto keep = [&](const coupling::Branch &branch)
  {
    if (branch.points.empty())
      return;
    table.add(branch);
    if (!branch.ended.empty())
      result.notes.push_back("branch " + std::to_string(result.entries.back().branch) + ": " +
                             end_of(branch, family, (along.to - along.from) / along.points));
    if (branch.failed)
      result.failure = result.notes.back();
  };
  // Branches that bifurcate from a branch, and from those.
  LeftBranches                                                  left(std::abs(along.to - along.from));
  const std::function<void(const coupling::Branch &, int, int)> shed =
      [&](const coupling::Branch &branch, int repeats, int generation)
  {
    for (const coupling::SpecialMotion &special : branch.special)
      if ((special.kind == "period doubling" || special.kind == "branch") && left.is_new(special) && !left.full())
      {
        const int times = special.kind == "branch" ? repeats : 2 * repeats;
        for (const auto &other : new_branches(family, special, options, along, times, on_point))
        {
          keep(other);
          // of branches that leave branches: beyond them cascades of period doubling do not end
          constexpr int generations = 2;
          if (generation < generations)
            shed(other, times, generation + 1);
        }
      }
  };
  for (const PeriodicSolution &first : solutions)
    if (!known(result, first, along.from, std::abs(along.to - along.from)))
      try
      {
        const int  repeats   = std::max(1, first.ratio / family.ratio());
        const auto equations = equations_for(family, first, options, repeats);
        const auto branch    = follow_branch(*equations, first, along, on_point);
        keep(branch);
        if (!first.series)
          shed(branch, repeats, 1);
      }
      catch (const std::runtime_error &none)
      {
        result.failure = none.what();
      }
}

} // namespace gestell::apps
