// Where alpha methods find the instants of switches that watch the force of a joint.

#include "tests/support/scene_run.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

double limiter_throws(const std::string &method, const std::string &limit)
{
  const SceneRun run("crane_minimal.toml", {"run.method=" + method, "run.end=2.66 s", "switch.limiter.above=" + limit});
  return run.result.events.at(0).t;
}

// The force of the cylinder grows by 1.4 N in a step of 0.1 ms, of 288 kN: multipliers that swing by a part in a
// million lead the event to an end of the step, or of the one beside it.  Both methods err by some 1e-8 s.
TEST(AlphaMethods, LocateSwitchesThatWatchAJointBetweenTheirSteps)
{
  for (const std::string limit : {"287.915 kN", "287.922 kN"})
    EXPECT_NEAR(limiter_throws("generalised-alpha", limit), limiter_throws("bdf", limit), 1e-6) << limit;
}

} // namespace
} // namespace gestell::tests
