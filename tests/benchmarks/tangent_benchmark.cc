// Exact tangent of the connecting rod: which dual numbers?  And what a law costs that is a formula.

#include "mechanism/elements/connecting_rod.h"
#include "mechanism/elements/formula_force.h"

#include <benchmark/benchmark.h>

#include <cmath>

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

// --- a formula: -(900 N/m)*u - 5e6 N/m^3 * u^3 - 20 N s/m * v + 10 N*sin(2*pi*3 Hz*t)

using gestell::mechanism::Formula;
using gestell::mechanism::FormulaForce;

FormulaForce shaken_spring()
{
  const Formula t = Formula::variable(FormulaForce::time), u = Formula::variable(FormulaForce::displacement),
                v = Formula::variable(FormulaForce::rate);
  return FormulaForce(
      {-(900. * u) - 5e6 * power(u, 3.) - 20. * v + 10. * applied(gestell::mechanism::Function::sin, 18.85 * t)});
}

/// The same written in C++.
class WrittenSpring : public gestell::mechanism::DifferentiableElement<WrittenSpring, 1>
{
public:
  template <typename Number>
  void law(const gestell::mechanism::Measures<Number> &m, const double *, Number *p) const
  {
    p[0] = -900. * m.u[0] - 5e6 * m.u[0] * m.u[0] * m.u[0] - 20. * m.v[0] + 10. * std::sin(18.85 * m.t);
  }
  std::vector<gestell::mechanism::Quantity> quantities() const override { return {}; }
  double quantity(int, const gestell::mechanism::LocalMotion &, const double *) const override { return 0.; }
};

void force_of(benchmark::State &state, const gestell::mechanism::ForceLaw &element)
{
  double t = 0.3, u = 0.01, v = 0.2, a = 0., p;
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(u);
    benchmark::DoNotOptimize(t);
    element.force({t, &u, &v, &a}, nullptr, &p);
    benchmark::DoNotOptimize(p);
  }
}

void tangent_of(benchmark::State &state, const gestell::mechanism::ForceLaw &element)
{
  double t = 0.3, u = 0.01, v = 0.2, a = 0., p, dp;
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(u);
    benchmark::DoNotOptimize(t);
    element.tangent({t, &u, &v, &a}, nullptr, {weights[0], weights[1], weights[2]}, &p, &dp);
    benchmark::DoNotOptimize(p);
    benchmark::DoNotOptimize(dp);
  }
}

BENCHMARK_CAPTURE(force_of, formula, shaken_spring());
BENCHMARK_CAPTURE(force_of, written, WrittenSpring());
BENCHMARK_CAPTURE(tangent_of, formula, shaken_spring());
BENCHMARK_CAPTURE(tangent_of, written, WrittenSpring());

} // namespace
