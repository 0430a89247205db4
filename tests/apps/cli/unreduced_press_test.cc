// The reduced press against the unreduced one, same integrator, over one cutting shock.

#include "tests/support/program.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

/// Extremes of F_P over the shock; the crank starts just before the punch touches.
std::pair<double, double> peaks(const std::string &method)
{
  const Folder folder("shock_" + method);
  const Answer answer =
      gestell("run " + scene("press.toml") + folder.option() + "--set reduction.method='\"" + method +
              "\"' --set parameters.phi_start='\"153 deg\"' --set run.end='\"65 ms\"' --set run.step='\"50 us\"' "
              "--set frame.mesh.size='\"200 mm\"' --set frame.mesh.'\"crown bearing *\"'='\"100 mm\"' ");
  EXPECT_EQ(answer.exit_code, 0) << answer.text;
  const std::string summary = read(folder.results() / "summary.json");
  return {json_number(summary, {"signals", "F_P", "min"}), json_number(summary, {"signals", "F_P", "max"})};
}

TEST(ReducedPress, MeetsThePeaksOfTheUnreducedOneWithinOnePercent)
{
  const auto reduced = peaks("craig-bampton"), full = peaks("none");
  EXPECT_NEAR(reduced.first, full.first, 0.01 * std::abs(full.first));
  EXPECT_NEAR(reduced.second, full.second, 0.01 * full.second);
}

} // namespace
} // namespace gestell::tests
