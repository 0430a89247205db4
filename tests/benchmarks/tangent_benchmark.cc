// Exact tangent of the connecting rod: which dual numbers?

#include "mechanism/elements/connecting_rod.h"

#include <benchmark/benchmark.h>

#ifdef GESTELL_HAVE_SACADO
#include <Sacado_No_Kokkos.hpp>

namespace Sacado::Fad::Exp
{

template <class Storage>
double value(const GeneralFad<Storage> &x)
{
  return x.val();
}

} // namespace Sacado::Fad::Exp
#endif

namespace
{

using gestell::mechanism::ConnectingRod;

const ConnectingRod rod({0.08, 0.8, 9e8, 1.8e5, 1e-4, 4e-4, 5e4});
constexpr double    weights[] = {1., 1.5e5, 2.25e10};

/// Measures in the branch of compression.
struct Motion
{
  double u[3] = {2.5, -0.1435, 2e-4}, v[3] = {3., 0.1, 0.02}, a[3] = {};
};

void force_alone(benchmark::State &state)
{
  Motion motion;
  double history = 0., p[3];
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(motion);
    rod.force({0., motion.u, motion.v, motion.a}, &history, p);
    benchmark::DoNotOptimize(p);
  }
}
BENCHMARK(force_alone);

void tangent_eigen(benchmark::State &state)
{
  Motion motion;
  double history = 0., p[3], dp[9];
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(motion);
    rod.tangent({0., motion.u, motion.v, motion.a}, &history, {weights[0], weights[1], weights[2]}, p, dp);
    benchmark::DoNotOptimize(dp);
  }
}
BENCHMARK(tangent_eigen);

#ifdef GESTELL_HAVE_SACADO
void tangent_sacado(benchmark::State &state)
{
  using Dual = Sacado::Fad::SFad<double, 3>;
  Motion motion;
  double history = 0.;
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(motion);
    Dual u[3], v[3], a[3], p[3];
    for (int i = 0; i < 3; ++i)
    {
      u[i]                 = Dual(3, i, motion.u[i]);
      v[i]                 = Dual(3, i, motion.v[i]);
      a[i]                 = Dual(3, i, motion.a[i]);
      u[i].fastAccessDx(i) = weights[0];
      v[i].fastAccessDx(i) = weights[1];
      a[i].fastAccessDx(i) = weights[2];
    }
    rod.law(gestell::mechanism::Measures<Dual>{0., u, v, a, false}, &history, p);
    benchmark::DoNotOptimize(p);
  }
}
BENCHMARK(tangent_sacado);
#endif

} // namespace
