// Steps of the integrators on the synthetic reduced frames of apps/scenes/benchmark, beside a plain condensed BDF2 with
// a dense Newton in the interface's coordinates, and beside a dense 200 x 200 product on the same machine.

#include "apps/scene/build/build_machine.h"
#include "apps/scene/scene.h"
#include "coupling/integration/integration_methods.h"
#include "coupling/integration/propagation/force_rule.h"

#include <Eigen/LU>
#include <benchmark/benchmark.h>

namespace
{

using namespace gestell;
using coupling::ForceRule;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double h     = 1e-5;  // [s]
constexpr long   steps = 20000; // of one run: 0.2 s of motion

coupling::Machine frame(int m)
{
  return apps::build_machine(
      apps::read_scene(std::string(GESTELL_SOURCE_DIR) + "/apps/scenes/benchmark/m" + std::to_string(m) + ".toml"));
}

void step(benchmark::State &state, coupling::MethodOptions method)
{
  coupling::Machine machine       = frame(static_cast<int>(state.range(0)));
  method.step                     = h;
  const auto           integrator = coupling::make_integrator(machine, method);
  const VectorXd       rest       = VectorXd::Zero(machine.size());
  coupling::LocalState local;
  machine.gather(0., rest, rest, rest, local);
  long done = steps;
  for (auto _ : state)
  {
    if (done == steps)
    {
      state.PauseTiming();
      machine.events().start(local);
      integrator->begin(0., rest, rest);
      integrator->advance();
      done = 1;
      state.ResumeTiming();
    }
    integrator->advance();
    machine.events().accept(integrator->local());
    ++done;
  }
  state.counters["coordinates"] = machine.size();
  state.counters["newton/step"] = double(integrator->work().newton) / double(integrator->work().steps);
}

coupling::MethodOptions bdf2()
{
  return {};
}
coupling::MethodOptions exact(ForceRule force)
{
  coupling::MethodOptions method;
  method.method = "exact";
  method.set("force", force_rule_name(force));
  method.order = 6;
  return method;
}

/// BDF2 as it is usually written: A condensed to the n_N interface coordinates, Newton in all of them with a dense
/// factorisation in every iteration.
void plain_condensed_bdf2(benchmark::State &state)
{
  coupling::Machine machine = frame(static_cast<int>(state.range(0)));
  const int         n = machine.size(), n_N = machine.model().n_interface(), n_L = n - n_N;
  MatrixXd          M, B, C;
  machine.linear().dense_matrices(M, B, C);
  const double   b          = 2. / 3. * h;
  const MatrixXd A          = M + b * B + b * b * C;
  const VectorXd inverse_LL = A.bottomRightCorner(n_L, n_L).diagonal().cwiseInverse();
  const MatrixXd G          = inverse_LL.asDiagonal() * A.bottomLeftCorner(n_L, n_N);
  const MatrixXd A_red      = A.topLeftCorner(n_N, n_N) - A.topRightCorner(n_N, n_L) * G;
  const MatrixXd W = MatrixXd(machine.forces().directions()), W_N = W.topRows(n_N);
  const auto     n_u = W.cols();

  VectorXd q(n), q_1(n), q_2(n), w_1(n), w_2(n), h_q(n), h_w(n), f(n), load(n), product(n), q_N(n_N), r(n_N);
  coupling::LocalState local;
  machine.gather(0., VectorXd::Zero(n), VectorXd::Zero(n), VectorXd::Zero(n), local);
  MatrixXd                      dp = MatrixXd::Zero(n_u, n_u), J(n_N, n_N);
  VectorXd                      g(n_u), g_rate(n_u), u_1(n_u), u_2(n_u), v_1(n_u), v_2(n_u);
  Eigen::PartialPivLU<MatrixXd> lu(n_N);
  long                          done = steps, newton = 0, total = 0;
  for (auto _ : state)
  {
    if (done == steps)
    {
      for (VectorXd *x : {&q_1, &q_2, &w_1, &w_2, &u_1, &u_2, &v_1, &v_2})
        x->setZero();
      machine.events().start(local);
      done = 0;
    }
    ++done;
    h_q     = (4. / 3.) * q_1 - (1. / 3.) * q_2;
    h_w     = (4. / 3.) * w_1 - (1. / 3.) * w_2;
    g       = (4. / 3.) * u_1 - (1. / 3.) * u_2;
    g_rate  = (4. / 3.) * v_1 - (1. / 3.) * v_2;
    local.t = double(done) * h;
    machine.linear().excitation().at(local.t, load);
    machine.linear().mass_times(h_q, f);
    f += b * h_w + (b * b) * load;
    q_N = 2. * q_1.head(n_N) - q_2.head(n_N);
    f.head(n_N).noalias() -= G.transpose() * f.tail(n_L);
    for (int iteration = 0; iteration < 25; ++iteration)
    {
      local.u.noalias() = W_N.transpose() * q_N;
      local.v           = (local.u - g) / b;
      local.a           = (local.v - g_rate) / b;
      machine.forces().tangent(local, 1., 1. / b, 1. / (b * b), local.p, dp);
      r = f.head(n_N) + (b * b) * (W_N * local.p) - A_red * q_N;
      J = A_red - (b * b) * (W_N * dp * W_N.transpose());
      lu.compute(J);
      const VectorXd step = lu.solve(r);
      q_N += step;
      ++newton;
      if (step.cwiseAbs().maxCoeff() <= 1e-10 * (1e-6 + q_N.cwiseAbs().maxCoeff()))
        break;
    }
    q.head(n_N) = q_N;
    q.tail(n_L) = inverse_LL.cwiseProduct(f.tail(n_L));
    q.tail(n_L).noalias() -= G * q_N;
    machine.linear().stiffness_times(q, product);
    w_2 = w_1;
    w_1 = h_w + b * (load - product);
    w_1.head(n_N) += b * (W_N * local.p);
    q_2 = q_1;
    q_1 = q;
    u_2 = u_1, v_2 = v_1;
    u_1 = local.u, v_1 = local.v;
    machine.events().accept(local);
    ++total;
  }
  state.counters["newton/step"] = double(newton) / double(total);
}

void dense_product_200(benchmark::State &state)
{
  const MatrixXd A = MatrixXd::Random(200, 200);
  VectorXd       x = VectorXd::Random(200), y(200);
  for (auto _ : state)
  {
    y.noalias() = A * x;
    benchmark::DoNotOptimize(y.data());
    benchmark::ClobberMemory();
  }
}

BENCHMARK(dense_product_200);
BENCHMARK(plain_condensed_bdf2)->Arg(20)->Arg(50)->Arg(200)->Iterations(200000);
BENCHMARK_CAPTURE(step, bdf2, bdf2())->Arg(20)->Arg(50)->Arg(200)->Iterations(200000);
BENCHMARK_CAPTURE(step, exact_linear, exact(ForceRule::linear))->Arg(20)->Arg(50)->Arg(200)->Iterations(200000);
BENCHMARK_CAPTURE(step, exact_average, exact(ForceRule::average))->Arg(20)->Arg(50)->Arg(200)->Iterations(200000);
BENCHMARK_CAPTURE(step, exact_collocation_6, exact(ForceRule::collocation))
    ->Arg(20)
    ->Arg(50)
    ->Arg(200)
    ->Iterations(200000);

} // namespace
