// One BDF2 step of the press: with two masses, and with its reduced frame (from the cache, or made first).

#include "apps/session/prepared_machine.h"
#include "coupling/integration/bdf/bdf.h"
#include "coupling/integration/system/energy_balance.h"

#include <benchmark/benchmark.h>

namespace
{

using namespace gestell;

void bdf2_steps(benchmark::State &state, const char *scene_file, const std::vector<std::string> &overrides)
{
  const apps::Scene scene = apps::read_scene(std::string(GESTELL_SOURCE_DIR) + "/apps/scenes/" + scene_file, overrides);
  apps::PreparedMachine prepared = apps::prepare_machine(scene);
  const auto            initial  = apps::prepare_start(scene, prepared);
  coupling::Machine    &machine  = prepared.machine;

  coupling::Bdf::Options options;
  options.step = scene.run.options.method.step;
  coupling::Bdf        bdf(machine, options);
  coupling::LocalState local;
  machine.gather(0., initial.q, initial.v, Eigen::VectorXd::Zero(machine.size()), local);
  const long n_steps = std::lround(scene.run.options.end / options.step);
  long       steps   = n_steps; // so that the first iteration begins a run
  for (auto _ : state)
  {
    if (steps == n_steps)
    {
      state.PauseTiming();
      machine.events().start(local);
      bdf.begin(0., initial.q, initial.v);
      bdf.advance();
      steps = 1;
      state.ResumeTiming();
    }
    bdf.advance();
    machine.events().accept(bdf.instant().local);
    ++steps;
  }
  state.counters["coordinates"] = machine.size();
  state.counters["newton/step"] = double(bdf.work().newton) / double(bdf.work().steps);
}

/// What Newton asks of the elements of the press once per iteration: forces and exact tangents, the rod's chain closed.
void press_elements(benchmark::State &state)
{
  const apps::Scene scene = apps::read_scene(std::string(GESTELL_SOURCE_DIR) + "/apps/scenes/press_minimal.toml", {});
  apps::PreparedMachine prepared = apps::prepare_machine(scene);
  const auto            initial  = apps::prepare_start(scene, prepared);
  coupling::Machine    &machine  = prepared.machine;
  coupling::LocalState  local;
  machine.gather(0., initial.q, initial.v, Eigen::VectorXd::Zero(machine.size()), local);
  machine.events().start(local);
  Eigen::VectorXd tangent = Eigen::VectorXd::Zero(coupling::tangent_size(machine.forces().blocks()));
  for (auto _ : state)
  {
    machine.forces().tangent_blocks(local, 1., 1e5, 1e10, local.p, tangent);
    benchmark::DoNotOptimize(tangent.data());
  }
}
BENCHMARK(press_elements);

// Whole runs of the scenes: 45 000 steps each, 20 000 of the portal.
BENCHMARK_CAPTURE(bdf2_steps, press_minimal, "press_minimal.toml", {})->Iterations(180000);
#ifdef GESTELL_WITH_FEM
BENCHMARK_CAPTURE(bdf2_steps, press_reduced, "press.toml", {})->Iterations(180000);
BENCHMARK_CAPTURE(bdf2_steps, press_40_modes, "press.toml", {"reduction.modes=40"})->Iterations(180000);
BENCHMARK_CAPTURE(bdf2_steps, portal_20, "portal_slider_crank.toml", {"reduction.modes=20"})->Iterations(200000);
BENCHMARK_CAPTURE(bdf2_steps, portal_50, "portal_slider_crank.toml", {"reduction.modes=50"})->Iterations(200000);
BENCHMARK_CAPTURE(bdf2_steps, portal_200, "portal_slider_crank.toml", {"reduction.modes=200"})->Iterations(200000);
#endif

} // namespace
