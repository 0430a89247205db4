// One BDF2 step of the press: with two masses, and with its reduced frame (from the cache, or made first).

#include "apps/session/prepared_machine.h"
#include "coupling/algebra/dense_modes.h"
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

enum class Damping
{
  rayleigh,
  modal,
  stored_inverse ///< modal, of a frame whose coordinates stay
};

/// Craig-Bampton coordinates: twelve of the interface, 200 modes, and dampers between points that move with all of
/// them.
coupling::ReducedFrame frame_with_dampers(Damping damping, int n_dampers)
{
  using Eigen::MatrixXd;
  using Eigen::VectorXd;
  constexpr int n1 = 12, m = 200, n = n1 + m;
  std::srand(1);
  coupling::ReducedFrame frame;
  frame.n_interface               = n1;
  frame.interfaces                = {{"a", {}, {0, 1, 2, 3, 4, 5}}, {"b", {}, {6, 7, 8, 9, 10, 11}}};
  frame.omega0                    = VectorXd::LinSpaced(m, 200., 2e4);
  const MatrixXd A                = MatrixXd::Random(n1, n1),
                 G                = 100. * frame.omega0.cwiseInverse().asDiagonal() * MatrixXd::Random(m, n1);
  frame.M                         = MatrixXd::Identity(n, n);
  frame.M.topLeftCorner(n1, n1)   = G.transpose() * G + A * A.transpose() + MatrixXd::Identity(n1, n1);
  frame.M.bottomLeftCorner(m, n1) = G;
  frame.M.topRightCorner(n1, m)   = G.transpose();
  frame.C                         = MatrixXd::Zero(n, n);
  frame.C.topLeftCorner(n1, n1)   = 1e6 * (A * A.transpose() + MatrixXd::Identity(n1, n1));
  frame.C.bottomRightCorner(m, m) = frame.omega0.cwiseAbs2().asDiagonal();
  frame.B                         = 10. * frame.M + 1e-6 * frame.C;
  frame.frequencies_hz            = VectorXd::Ones(n);
  frame.translations_load         = MatrixXd::Zero(n, 3);
  frame.modal                     = damping != Damping::stored_inverse;
  if (damping != Damping::rayleigh)
  {
    const auto     own = coupling::dense_modes(frame.C, frame.M);
    const MatrixXd Z   = frame.M * own.V;
    frame.B            = Z * (0.04 * own.omega).asDiagonal() * Z.transpose();
  }
  const MatrixXd dampers = 10. * MatrixXd::Random(n, n_dampers);
  frame.B += dampers * dampers.transpose();
  return frame;
}

void steps_with_dampers(benchmark::State &state, Damping damping)
{
  coupling::MachineModel model;
  model.set_frame(frame_with_dampers(damping, int(state.range(0))));
  const coupling::Machine machine(std::move(model));
  coupling::Bdf::Options  options;
  options.step = 1e-5;
  coupling::Bdf         bdf(machine, options);
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(machine.size());
  Eigen::VectorXd       v    = zero;
  v[0]                       = 1.;
  bdf.begin(0., zero, v);
  bdf.advance();
  for (auto _ : state)
    bdf.advance();
}
BENCHMARK_CAPTURE(steps_with_dampers, rayleigh, Damping::rayleigh)->Arg(0)->Arg(6)->Arg(24);
BENCHMARK_CAPTURE(steps_with_dampers, modal, Damping::modal)->Arg(0)->Arg(6)->Arg(12)->Arg(24)->Arg(36);
BENCHMARK_CAPTURE(steps_with_dampers, stored_inverse, Damping::stored_inverse)->Arg(6);

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
