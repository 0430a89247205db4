// One step of N four-bars with ideal joints: how its cost grows with N, condensed and sparse.

#include "coupling/integration/integration_methods.h"
#include "tests/support/jointed_machines.h"

#include <benchmark/benchmark.h>

namespace
{

using namespace gestell;
using coupling::JointSolver;

void four_bar_steps(benchmark::State &state, JointSolver solver)
{
  coupling::Machine     machine = tests::n_four_bar(int(state.range(0)));
  const Eigen::VectorXd q       = Eigen::VectorXd::Zero(machine.size());
  const Eigen::VectorXd v       = tests::swinging_four_bars(machine);

  coupling::MethodOptions options;
  options.step                    = 1e-3;
  options.newton.joints           = solver;
  const auto           integrator = coupling::make_integrator(machine, options);
  coupling::LocalState local;
  machine.gather(0., q, v, q, local);
  const int n_steps = 2000; // before the bars have turned once
  int       steps   = n_steps;
  for (auto _ : state)
  {
    if (steps == n_steps)
    {
      state.PauseTiming();
      machine.events().start(local);
      integrator->begin(0., q, v);
      for (steps = 0; steps < 8; ++steps)
        integrator->advance();
      state.ResumeTiming();
    }
    integrator->advance();
    ++steps;
  }
  const auto &work                = integrator->work();
  state.counters["coordinates"]   = machine.size();
  state.counters["newton/step"]   = double(work.newton) / double(work.steps);
  state.counters["factored/step"] = double(work.factorisations) / double(work.steps);
}
/// N = 1, 2, 5, 10 and further where a step is cheap enough.
void up_to_10(benchmark::internal::Benchmark *b)
{
  b->Unit(benchmark::kMicrosecond)->Arg(1)->Arg(2)->Arg(5)->Arg(10);
}
void up_to_40(benchmark::internal::Benchmark *b)
{
  up_to_10(b);
  b->Arg(20)->Arg(40);
}
void up_to_80(benchmark::internal::Benchmark *b)
{
  up_to_40(b);
  b->Arg(80);
}
BENCHMARK_CAPTURE(four_bar_steps, automatic, JointSolver::automatic)->Apply(up_to_80);
BENCHMARK_CAPTURE(four_bar_steps, sparse, JointSolver::sparse)->Apply(up_to_10);
BENCHMARK_CAPTURE(four_bar_steps, condensed, JointSolver::condensed)->Apply(up_to_40);

} // namespace
