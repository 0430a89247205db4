// What stands beside a run neither stops it nor is silent: its modes, and what rounding leaves of a stiff spring.

#include "apps/session/session.h"
#include "tests/support/scene_parts.h"
#include "tests/support/scene_run.h"
#include "tests/support/test.h"

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
  EXPECT_THAT(result.warnings, Contains(HasSubstr("the modes are those of the initial state")));
  ASSERT_EQ(result.coupled_modes.size(), 1u);
  // c = 100 N/m + d/du 1 N sqrt(u/mm) = 100 + 500/sqrt(10) N/m at 10 mm.
  EXPECT_NEAR(result.coupled_modes[0].frequency_hz, std::sqrt(100. + 500. / std::sqrt(10.)) / (2. * M_PI), 1e-4);
}

/// Two masses of 1 kg on 1 kN/m, tied by a spring beside which that one is lost from epsilon c = 1 kN/m on, 5e18 N/m:
/// they stand still then, and nothing else tells.
TEST(BesideTheRun, ForcesThatAreRoundingAreReported)
{
  const auto warnings = [](const std::string &stiffness)
  {
    return coupling::texts_of(
        run_of(slider_body("a", "1", "[1, 0, 0]") + slider_body("b", "1", "[1, 0, 0]") +
               element("base", "spring-damper", {{"from", "a"}, {"stiffness", "1000"}}) +
               element("link", "spring-damper", {{"from", "a"}, {"to", "b"}, {"stiffness", stiffness}}) +
               start("q = { a = '10 mm', b = '10 mm' }") + signals("a = 'a.displacement', F = 'link.force'") +
               steps("10 us", "0.1 s"))
            .run->findings);
  };
  for (const char *stiff : {"1e17", "1e18", "1e20", "1e21"})
    EXPECT_THAT(warnings(stiff), Contains(HasSubstr("forces on "))) << stiff;
  for (const char *stiff : {"1e4", "1e9", "1e12", "1e14"})
    EXPECT_THAT(warnings(stiff), Not(Contains(HasSubstr("forces on ")))) << stiff;
}

} // namespace gestell::tests
