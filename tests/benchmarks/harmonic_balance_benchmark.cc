// One Newton iteration of harmonic balance, at equal measures, of a chain with 20 ... 200 modes: the base stands in
// tables of the measures alone, formed anew for each frequency as on a curve of resonance.

#include "coupling/periodic/harmonic/harmonic_balance.h"
#include "tests/support/cubic_system.h"

#include <benchmark/benchmark.h>

namespace
{

using namespace gestell;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Masses on springs to their neighbours, four of them on cubic springs; a damper that couples all modes and a load on
/// the last one.
tests::CubicSystem chain(int n)
{
  MatrixXd C = MatrixXd::Zero(n, n);
  for (int i = 0; i < n; ++i)
  {
    C(i, i) = 2.;
    if (i > 0)
      C(i, i - 1) = C(i - 1, i) = -1.;
  }
  const MatrixXd                          M = MatrixXd::Identity(n, n);
  std::vector<tests::CubicSystem::Spring> springs;
  for (int k = 1; k <= 4; ++k)
    springs.push_back({0.5, VectorXd::Unit(n, k * n / 5)});
  MatrixXd B      = 0.02 * M + 0.02 * C;
  B(n - 1, n - 1) = 0.1;
  tests::CubicSystem system(M, B, C, springs);
  system.loads().add_harmonic(n - 1, 0.3, 0.1, 0.);
  return system;
}

void harmonic_balance_iteration(benchmark::State &state)
{
  tests::CubicSystem        system = chain(int(state.range(0)));
  coupling::PeriodicProblem problem;
  problem.system = &system;
  problem.period = 2. * M_PI / 0.3;
  problem.turn   = VectorXd::Zero(system.size());
  coupling::HarmonicBalance balance(problem, 20);
  VectorXd                  z = balance.linear_start(), r;
  MatrixXd                  J;
  int                       count = 0;
  for (auto _ : state)
  {
    balance.set_period(problem.period * (1. + 1e-6 * (++count % 2)));
    balance.linearise(z, r, J);
    const VectorXd step = J.partialPivLu().solve(r);
    benchmark::DoNotOptimize(step.data());
  }
  state.counters["unknowns"] = balance.size();
}
BENCHMARK(harmonic_balance_iteration)->Arg(20)->Arg(50)->Arg(100)->Arg(200);

} // namespace
