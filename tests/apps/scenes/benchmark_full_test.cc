// The benchmark of the integrators over its whole 2 s.

#include "tests/support/benchmark_error.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

long contact_changes(const SceneRun &run)
{
  return std::count_if(run.result.events.begin(), run.result.events.end(),
                       [](const auto &event) { return event.name == "play"; });
}

TEST(BenchmarkInFull, Bdf2KeepsItsErrorThroughHundredsOfContacts)
{
  const SceneRun run("benchmark/m20.toml");
  EXPECT_EQ(run.n_rows(), 2001u);
  EXPECT_LT(benchmark_error(run), 6e-4); // observed 3.6e-4
}

TEST(BenchmarkInFull, ExactPropagationReachesTheErrorOfTheReference)
{
  const SceneRun run("benchmark/m20.toml", {"run.method=exact", "run.order=4"});
  // The reference itself is told to be good to 1e-6.
  EXPECT_LT(benchmark_error(run), 2e-6);
  EXPECT_GT(contact_changes(run), 60);
}

TEST(BenchmarkInFull, ToleranceControlsTheError)
{
  for (const std::string method : {"bdf", "exact"})
  {
    const double coarse =
                     benchmark_error(SceneRun("benchmark/m20.toml", {"run.method=" + method, "run.tolerance=1e-4"})),
                 fine = benchmark_error(SceneRun("benchmark/m20.toml", {"run.method=" + method, "run.tolerance=1e-6"}));
    EXPECT_LT(coarse, 3e-2) << method;
    EXPECT_LT(fine, coarse / 8.) << method;
  }
}

} // namespace
} // namespace gestell::tests
