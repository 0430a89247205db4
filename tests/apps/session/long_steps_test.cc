// Exact propagation takes steps longer than a period where nothing but the linear base acts: events within them.

#include "apps/session/session.h"
#include "tests/support/scene_parts.h"
#include "tests/support/scene_run.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using apps::Result;
using apps::Session;

std::string exact_run(double end)
{
  return test::quoted("[run]\nmethod = 'exact'\norder = 6\ntolerance = 1e-9\nend = " + number(end) + "\n");
}

Result long_run_of(const std::string &text)
{
  const test::SceneFolder folder;
  return Session(folder.write("scene.toml", text)).run();
}

/// w = 10 1/s, 10 % of critical damping, thrown against a stop.
std::string thrown(double end)
{
  return slider_body("slide", "1", "[1, 0, 0]") +
         element("spring", "spring-damper", {{"from", "slide"}, {"stiffness", "100"}, {"damping", "2"}}) +
         element("stop", "stop", {{"from", "slide"}, {"gap", "0.02"}, {"stiffness", "1e5"}}) +
         test::quoted("[start]\nv = { slide = 0.5 }\n[output.signals]\nx = 'slide.displacement'\n") + exact_run(end);
}

} // namespace

/// How long the run is asked to be changes nothing of its begin: longer first steps pass over no stop.  Instants and
/// extremes differ by what steps of a tolerance of 1e-9 leave after some contacts of 1e5 N/m.
TEST(LongSteps, SkipNoStop)
{
  const Result near = long_run_of(thrown(2.));
  ASSERT_GE(near.run->events.size(), 2u);
  for (const double end : {60., 300., 3000.})
  {
    const Result far = long_run_of(thrown(end));
    ASSERT_EQ(far.run->events.size(), near.run->events.size()) << end;
    for (std::size_t i = 0; i < far.run->events.size(); ++i)
      EXPECT_NEAR(far.run->events[i].t, near.run->events[i].t, 1e-7) << end;
    EXPECT_NEAR(far.run->signals[0].max, near.run->signals[0].max, 1e-8) << end;
  }
}

/// A belt that drags a damped mass: the mass is never faster than it, whatever the run's length.
TEST(LongSteps, SkipNoStickingToABelt)
{
  const double vb = 0.06;
  for (const double end : {20., 60., 300.})
  {
    const Result result =
        long_run_of(slider_body("slide", "1", "[1, 0, 0]") +
                    element("spring", "spring-damper", {{"from", "slide"}, {"stiffness", "100"}, {"damping", "2"}}) +
                    element("belt", "dry friction",
                            {{"from", "slide"}, {"kinetic_force", "2"}, {"static_force", "3"}, {"speed", number(vb)}}) +
                    test::quoted("[output.signals]\nv = 'slide.velocity'\n") + exact_run(end));
    EXPECT_NEAR(result.run->signals[0].max, vb, 1e-8) << end;
    EXPECT_GT(result.run->events.size(), 10u) << end;
  }
}

} // namespace gestell::tests
