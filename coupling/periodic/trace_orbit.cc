#include "coupling/periodic/trace_orbit.h"

#include "coupling/periodic/period_flow.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace gestell::coupling
{

namespace
{

/// The laws follow the motion itself; friction that sticks has the force of its law at rest.
void trace_series(const PeriodicProblem &problem, const PeriodicSolution &solution, int samples,
                  const std::function<void(const OrbitPoint &)> &look)
{
  SecondOrderSystem &system = *problem.system;
  const auto        &W      = system.forces().directions();
  Eigen::VectorXd    q, v, a;
  LocalState         local;
  local.resize(system);
  system.events().follow_history(false);
  for (int k = 0; k <= samples; ++k)
  {
    local.t = solution.begin + solution.period * k / samples;
    solution.series->at(local.t, q, v, a);
    local.u = W.transpose() * q;
    local.v = W.transpose() * v;
    local.a = W.transpose() * a;
    if (k == 0)
      system.events().start(local);
    system.forces().force(local, local.p);
    system.events().accept(local);
    look({local.t, q, v, local});
  }
}

/// From state to state.
void trace_parts(PeriodFlow &flow, const PeriodicSolution &solution, int samples,
                 const std::function<void(const OrbitPoint &)> &look)
{
  int k = 0;
  for (std::size_t i = 0; i < solution.states.size(); ++i)
  {
    const OrbitState   &from = solution.states[i];
    const bool          last = i + 1 == solution.states.size();
    const double        end  = last ? solution.begin + solution.period : solution.states[i + 1].t;
    std::vector<double> shares;
    for (; k <= samples; ++k)
    {
      const double t = solution.begin + solution.period * k / samples;
      if (!last && t >= end)
        break;
      shares.push_back(k == samples ? 1. : std::clamp((t - from.t) / (end - from.t), 0., 1.));
    }
    flow.look_at(shares, look);
    flow.pass_part(from.q, from.v, from.t, end, false);
  }
}

} // namespace

void trace(const PeriodicProblem &problem, const PeriodicSolution &solution, int samples,
           const std::function<void(const OrbitPoint &)> &look)
{
  if (solution.series)
  {
    trace_series(problem, solution, samples, look);
    return;
  }
  PeriodFlow flow(problem, solution.integration);
  if (!solution.states.empty())
  {
    trace_parts(flow, solution, samples, look);
    return;
  }
  flow.look_on(samples, look);
  flow.pass(solution.q, solution.v, solution.period, false);
}

int own_ratio(const PeriodicProblem &problem, const PeriodicSolution &solution)
{
  constexpr double             same  = 1e-6; // distance of two states of one motion, of their size
  const double                 omega = 2. * M_PI / solution.period * solution.ratio;
  std::vector<Eigen::VectorXd> states;
  if (solution.ratio == 1)
    return 1;
  trace(problem, solution, solution.ratio,
        [&](const OrbitPoint &point)
        {
          const double gone = (point.t - solution.begin) / solution.period;
          states.emplace_back(2 * point.q.size());
          states.back() << omega * (point.q - gone * solution.turn), point.v;
        });
  int k = 1;
  while (k < solution.ratio &&
         (solution.ratio % k != 0 || (states[std::size_t(k)] - states[0]).norm() > same * states[0].norm()))
    ++k;
  return k;
}

} // namespace gestell::coupling
