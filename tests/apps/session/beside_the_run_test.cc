// What stands beside a run neither stops it nor is silent: its modes, and what rounding leaves of a stiff spring.

#include "apps/session/session.h"
#include "tests/support/scene_parts.h"
#include "tests/support/scene_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace gestell::tests
{
namespace
{

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

/// 1 kg on a spring of 100 N/m against a force whose slope is infinite at u = 0; it swings about 13 mm.
std::string root_law(const std::string &at)
{
  return slider_body("slide", "1", "[1, 0, 0]") +
         element("spring", "spring-damper", {{"from", "slide"}, {"stiffness", "100"}}) +
         element("law", "formula force", {{"from", "slide"}, {"force", "5 N - 1 N*sqrt(u/mm)"}}) +
         start("q = { slide = '" + at + "' }") + signals("x = 'slide.displacement'") + steps("1 ms", "0.5 s");
}

apps::Result run_of(const std::string &text)
{
  const test::SceneFolder folder;
  return apps::Session(folder.write("scene.toml", text)).run();
}

} // namespace

TEST(BesideTheRun, ModesAreThoseOfTheStartWhereTheUndeformedMachineHasNone)
{
  const apps::Result result = run_of(root_law("10 mm"));
  EXPECT_EQ(result.run->failure, "");
  EXPECT_GT(result.run->signals[0].max, 0.012);
  EXPECT_THAT(result.warnings, Contains(HasSubstr("the modes are those of the start")));
  ASSERT_EQ(result.coupled_modes.size(), 1u);
  // c = 100 N/m + d/du 1 N sqrt(u/mm) = 100 + 500/sqrt(10) N/m at 10 mm.
  EXPECT_NEAR(result.coupled_modes[0].frequency_hz, std::sqrt(100. + 500. / std::sqrt(10.)) / (2. * M_PI), 1e-4);
}

TEST(BesideTheRun, MassesThatRoundingHidesAreToldOf)
{
  const auto warnings = [](const std::string &stiffness) {
    return SceneRun("press_minimal.toml", {"parameters.c_P=\"" + stiffness + "\"", "run.end=0.001"}).result.warnings;
  };
  EXPECT_THAT(warnings("1e30 N/m"), Contains(HasSubstr("rounding hides the masses")));
  EXPECT_THAT(warnings("1e12 N/m"), Not(Contains(HasSubstr("rounding hides"))));
}

} // namespace gestell::tests
