#include "coupling/periodic/trace_orbit.h"

#include "coupling/periodic/period_flow.h"

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
  flow.look_on(samples, look);
  flow.pass(solution.q, solution.v, solution.period, false);
}

} // namespace gestell::coupling
