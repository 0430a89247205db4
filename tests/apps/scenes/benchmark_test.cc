// The benchmark of the integrators against its reference solution (tests/reference/numerics/benchmark).

#include "tests/support/benchmark_error.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

TEST(Benchmark, KeepsTheModesApartFromTheInterface)
{
  for (const int m : {20, 50, 200})
  {
    const apps::Scene       scene   = apps::read_scene(shipped("benchmark/m" + std::to_string(m) + ".toml"));
    const coupling::Machine machine = apps::build_machine(scene);
    EXPECT_EQ(machine.size(), 12 + m);
    EXPECT_EQ(machine.model().n_interface(), 12);
    ASSERT_TRUE(machine.model().reduced_frame()->modal);
    const auto &omega = machine.model().reduced_frame()->omega0;
    ASSERT_EQ(omega.size(), m);
    EXPECT_NEAR(omega[0], 2. * M_PI * 20., 1e-9);
    EXPECT_NEAR(omega[m - 1], 2. * M_PI * 5000., 1e-7);
  }
}

TEST(Benchmark, Bdf2MeetsTheReferenceAsFarAsItsStepAllows)
{
  // Observed 5.1e-4: BDF2 lengthens a period by the share (omega h)^2/3, 4e-3 where a contact of 11 krad/s is closed.
  const SceneRun run("benchmark/m20.toml", {"run.end=0.05"});
  EXPECT_EQ(run.n_rows(), 51u);
  EXPECT_LT(benchmark_error(run), 8e-4);
}

TEST(Benchmark, ErrorOfBdf2FallsWithTheStep)
{
  const double coarse = benchmark_error(SceneRun("benchmark/m20.toml", {"run.end=0.05", "run.step=\"10 us\""})),
               fine   = benchmark_error(SceneRun("benchmark/m20.toml", {"run.end=0.05", "run.step=\"2.5 us\""}));
  // A quarter of the step would give 1/16 on a smooth motion; contacts leave less.
  EXPECT_LT(fine, coarse / 8.);
}

} // namespace
} // namespace gestell::tests
