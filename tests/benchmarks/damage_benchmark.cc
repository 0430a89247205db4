// The worst point of damage by bounds, as a part of the CPU time of counting the cycles of all points, and the number
// of points whose cycles were counted.

#include "tests/support/notched_plate.h"

#include <benchmark/benchmark.h>

#include <ctime>

namespace
{

using namespace gestell;
using namespace apps;

double cpu_seconds()
{
  return double(std::clock()) / CLOCKS_PER_SEC;
}

DamageRule rule_of(MeanStress::Rule mean_stress)
{
  return {table_curve({{1e4, 2e8}, {1e6, 6e7}, {1e8, 2e7}}, 1., -1.), {mean_stress, 6e8, 0.2}, Miner::elementary};
}

/// Argument 0: the measure; 1: the mean stress effect; 2: 1 the worst point, or 5 places that are apart.
void worst_points_of_damage(benchmark::State &state)
{
  constexpr int             points = 4000, all_of = 40; // every fortieth is counted
  const tests::NotchedPlate plate(points, 20000);
  const LoadSequence        load   = plate.load();
  const DamageRule          rule   = rule_of(MeanStress::Rule(state.range(1)));
  DamageSearch              search = plate.search(StressMeasure(state.range(0)), int(state.range(2)));
  search.distance                  = search.worst > 1 ? 0.2 : 0.;
  const double begin               = cpu_seconds();
  for (int i = 0; i < points; i += all_of)
    benchmark::DoNotOptimize(point_damage(plate.stress, plate.states, load, rule, search, i).damage);
  const double counted = (cpu_seconds() - begin) * all_of;
  double       bounded = 0.;
  WorstPoints  found;
  for (auto _ : state)
  {
    const double start = cpu_seconds();
    found              = worst_points(plate.stress, plate.states, load, rule, search);
    bounded += cpu_seconds() - start;
  }
  state.counters["part_of_all"] = bounded / double(state.iterations()) / counted;
  state.counters["looked_at"]   = found.looked_at;
}

} // namespace

BENCHMARK(worst_points_of_damage)
    ->ArgsProduct({{int(StressMeasure::normal), int(StressMeasure::signed_von_mises),
                    int(StressMeasure::critical_plane)},
                   {int(MeanStress::Rule::none), int(MeanStress::Rule::goodman), int(MeanStress::Rule::fkm)},
                   {1, 5}})
    ->Unit(benchmark::kMillisecond);
