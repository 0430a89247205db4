// What a journal in its bearing costs per Newton iteration: in the play, and pressed and rubbing.

#include "mechanism/elements/journal_bearing.h"
#include "mechanism/transmitted_element.h"

#include <benchmark/benchmark.h>

namespace
{

using namespace gestell::mechanism;

constexpr double                            weights[] = {1., 1.5e5, 2.25e10};
const std::vector<Placement::LinearMeasure> plane     = {{Vector3d::UnitX(), Vector3d::Zero()},
                                                         {Vector3d::UnitZ(), Vector3d::Zero()}};

/// Between a rod in a plane (three measures) and a crank (one).
TransmittedElement journal()
{
  RelativeMeasure y[2], turn;
  for (int i = 0; i < 2; ++i)
    y[i].carrier = RelativeMeasure::Carrier::first;
  y[0].a      = Vector3d::UnitX();
  y[1].a      = -Vector3d::UnitZ();
  turn.form   = RelativeMeasure::Form::ratio;
  turn.ratios = {0., 0., -1., 1.};
  const Vector3d at(0., 0., 0.05), n = Vector3d::UnitY();
  return {Placement(at, Vector3d(0.1, 0., 0.025), plane, n),
          Placement(at, Vector3d::Zero(), {}, n),
          {y[0], y[1], turn},
          std::make_shared<JournalBearing>(
              JournalBearing::Parameters{5e-4, 0.02, 3e7, 1., 1., SlidingFriction{0.05, 5e-3}})};
}

void journal_tangent(benchmark::State &state, double eccentricity)
{
  const TransmittedElement element = journal();
  double                   u[] = {eccentricity, 0., 0.02, 0.02}, v[] = {0.01, -0.02, 3., 15.}, a[4] = {};
  double                   history = 0., p[4], dp[16];
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(u);
    element.tangent({0., u, v, a}, &history, {weights[0], weights[1], weights[2]}, p, dp);
    benchmark::DoNotOptimize(dp);
  }
}
BENCHMARK_CAPTURE(journal_tangent, in_play, 1e-4);
BENCHMARK_CAPTURE(journal_tangent, pressed, 4e-3);

} // namespace
