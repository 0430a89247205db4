#include "coupling/periodic/periodic_solution.h"

#include "coupling/periodic/period_flow.h"

#include <algorithm>
#include <cmath>

namespace gestell::coupling
{

void FourierSeries::at(double t, Eigen::VectorXd &q, Eigen::VectorXd &v, Eigen::VectorXd &a) const
{
  q = cosine.col(0) + (t - begin) * ramp;
  v = ramp;
  a.setZero(q.size());
  for (int h = 1; h <= harmonics(); ++h)
  {
    const double w = h * omega, c = std::cos(w * t), s = std::sin(w * t);
    q += c * cosine.col(h) + s * sine.col(h);
    v += w * (c * sine.col(h) - s * cosine.col(h));
    a -= w * w * (c * cosine.col(h) + s * sine.col(h));
  }
}

void PeriodicWork::add(const PeriodicWork &other)
{
  iterations += other.iterations;
  periods += other.periods;
  integration.steps += other.integration.steps;
  integration.rejected += other.integration.rejected;
  integration.newton += other.integration.newton;
  integration.factorisations += other.integration.factorisations;
  integration.solves += other.integration.solves;
  integration.evaluations += other.integration.evaluations;
}

double PeriodicSolution::largest_multiplier() const
{
  if (!stability_is_known())
    return std::numeric_limits<double>::quiet_NaN();
  Eigen::Index trivial = -1;
  if (trivial_multiplier)
    (multipliers.array() - 1.).abs().minCoeff(&trivial);
  double largest = 0.;
  for (Eigen::Index i = 0; i < multipliers.size(); ++i)
    if (i != trivial)
      largest = std::max(largest, std::abs(multipliers[i]));
  return largest;
}

double closing_error(const Eigen::VectorXd &dq, const Eigen::VectorXd &dv, double omega, double fastest)
{
  const double F = dq.squaredNorm() * omega * omega + dv.squaredNorm();
  return F == 0. ? 0. : std::sqrt(F) / fastest;
}

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
