#include "apps/analysis/periodic/periodic_motions.h"

#include "apps/analysis/periodic/backbone.h"
#include "apps/analysis/periodic/basin_answer.h"
#include "apps/analysis/periodic/long_run.h"
#include "apps/analysis/periodic/periodic_branches.h"
#include "apps/analysis/periodic/periodic_entry.h"
#include "apps/analysis/periodic/phase_planes.h"
#include "apps/scene/build/build_machine.h"
#include "coupling/periodic/settling.h"

#include <algorithm>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

constexpr int orbit_rows = 512; ///< of a period: extremes to (pi / 512)^2 / 2 = 2e-5

/// The solutions by a second method, compared with the first of them.
void add_checks(coupling::Machine &machine, const RepeatingMachine &repeating, const coupling::PeriodicOptions &options,
                const std::string &name, const std::vector<coupling::Signal> &signals, PeriodicResult &found)
{
  const ChosenMethod second = chosen_method(repeating, name);
  for (const PeriodicEntry &entry : found.entries)
    try
    {
      const coupling::PeriodicGuess near{entry.solution.q, entry.solution.v, entry.solution.period};
      coupling::PeriodicProblem     problem = repeating.problem;
      if (!problem.period_is_unknown()) // it may repeat after several periods only
      {
        problem.period = entry.solution.period;
        problem.ratio  = entry.solution.ratio;
        problem.turn   = entry.solution.turn;
      }
      const auto solutions = second.method->solve(problem, near, without_lead_in(options));
      found.checks.push_back(compared(entry, entry_of(machine, problem, solutions.front(), signals, orbit_rows), name));
    }
    catch (const std::exception &none) // among them what the method refuses of this motion
    {
      found.checks.push_back({name, {}, none.what()});
    }
}

/// Solutions of the method; none if it fails, with the reason in `found`.
std::vector<coupling::PeriodicSolution> searched(const ChosenMethod &chosen, const coupling::PeriodicProblem &problem,
                                                 const coupling::PeriodicGuess   &guess,
                                                 const coupling::PeriodicOptions &options, PeriodicResult &found)
{
  try
  {
    auto solutions = chosen.method->solve(problem, guess, options);
    for (auto &solution : solutions)
      solution = of_own_period(*chosen.method, problem, solution, options);
    return solutions;
  }
  catch (const std::runtime_error &none)
  {
    found.failure = none.what();
    return {};
  }
}

} // namespace

void begin_branches(Session &session, const PeriodicRequest &request)
{
  if (request.along.empty())
    return;
  if (request.from.empty() || request.to.empty())
    throw std::invalid_argument("--along " + request.along + ": --from and --to are missing");
  if (session.scene().reduction.superposition)
    throw std::invalid_argument("--along is not possible with reduction.method = \"modal\", whose modes change with " +
                                request.along + "; use reduction.method = \"craig-bampton\"");
  require_parameter(session.variant(), request.along);
  session.vary(request.along + '=' + request.from);
}

PeriodicResult periodic_motions(Session &session, const PeriodicRequest &request, Result &result)
{
  const Scene       &scene    = session.scene();
  PreparedMachine   &prepared = session.machine();
  coupling::Machine &machine  = prepared.machine;
  const auto         signals  = scene_signals(scene, machine);
  const auto         now      = session.progress();
  now("start", -1.);
  const coupling::InitialState start     = prepare_start(scene, prepared);
  const RepeatingMachine       repeating = repeating_machine(scene, machine, start, request, session.interruption());
  check_long_run(request);
  check_basins(machine, repeating.problem, request);
  const ChosenMethod chosen = chosen_method(repeating, request.method);
  check_options(request, *chosen.method);
  if (!request.check.empty())
    chosen_method(repeating, request.check);
  const auto     options = periodic_options(scene, request, machine);
  PeriodicResult found;
  found.method = chosen.method->name();
  found.reason = chosen.reason + "; " + repeating.reason;
  for (int i = 0; i < machine.size(); ++i)
    found.coordinates.push_back({machine.coordinate_name(i), coordinate_sign(machine, i)});
  std::optional<SceneFamily> family;
  if (!request.along.empty())
    family.emplace(session.variant(), prepared, request, repeating.problem);
  now("periodic solutions", -1.);
  const coupling::PeriodicGuess &guess     = repeating.guess;
  auto                           solutions = searched(chosen, repeating.problem, guess, options, found);
  follow_long_run(machine, repeating.problem, guess, options, request, signals, solutions, found);
  for (const auto &solution : solutions)
    found.work.add(solution.work);
  if (family)
  {
    found.parameter      = request.along;
    found.parameter_unit = family->unit();
    follow_branches(
        *family, solutions, options, request, [&](double share) { now("branches", share); }, repeating.problem.stop,
        found);
    found.backbone = backbone_of(machine, repeating.problem, found.entries, signals);
  }
  else
  {
    for (const auto &solution : solutions)
    {
      const bool shown = !result.run && solution.stable();
      found.entries.push_back(
          entry_of(machine, repeating.problem, solution, signals, orbit_rows, shown ? &result.run : nullptr));
    }
    found.planes = phase_planes(machine, repeating.problem, found.entries, signals);
    find_basins(
        machine, repeating.problem, guess, solutions, options, request, [&](double share) { now("basins", share); },
        found);
  }
  if (!request.check.empty())
    add_checks(machine, repeating, options, request.check, signals, found);
  found.interrupted = repeating.problem.interrupted();
  const auto stable = std::find_if(found.entries.begin(), found.entries.end(),
                                   [](const PeriodicEntry &entry) { return entry.solution.stable(); });
  if (stable != found.entries.end() && request.along.empty() && !result.run)
    result.run = orbit_run(machine, stable->solution, signals, orbit_rows);
  if (result.run)
    prepared.project_pictures(*result.run);
  return found;
}

} // namespace gestell::apps
