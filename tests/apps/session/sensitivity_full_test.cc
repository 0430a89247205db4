// Derivatives of runs by entries of their FE frame, against runs on frames reduced anew.

#include "tests/apps/session/differentiated.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using apps::Session;

const std::string scene = GESTELL_SOURCE_DIR "/apps/scenes/portal_slider_crank.toml";

double value_of(const apps::Result &result, const std::string &name)
{
  for (const auto &signal : result.run->signals)
    if (name == signal.name + ".max")
      return signal.max;
    else if (name == signal.name + ".final")
      return signal.final;
  return result.run->events.at(0).t;
}

TEST(FrameSensitivities, ByTheDensityOfTheFrameAreQuotientsOfRuns)
{
  // Rounding in the reductions scatters forces by 2e-8 (measured): 3e-4 of a quotient over 0.4 % of the density, 6e-4 of
  // the differences of two reductions that the derivative rests on; the square of the share adds 3e-4.
  const std::vector<std::string> overrides = {"material.mine={E='210 GPa',nu=0.3,rho='7850 kg/m^3'}",
                                              "frame.material=mine", "run.tolerance=1e-9", "run.end=1.6 s"};
  const auto found = sensitivities_of(differentiated(Session(scene, overrides), "material.mine.rho"));
  EXPECT_NE(found.keys[0].frame.find("differences of two reductions"), std::string::npos);
  const auto with = [&](const char *density)
  {
    auto more = overrides;
    more.push_back(std::string("material.mine.rho=") + density);
    return Session(scene, more).run();
  };
  const apps::Result below = with("7834.3 kg/m^3"), above = with("7865.7 kg/m^3");
  for (const std::string name : {"events.1.t", "F_stop.max", "F_A.max", "u_right.max", "x.max", "omega.final"})
    for (const auto &output : found.outputs)
      if (output.output == name)
      {
        const double quotient = (value_of(above, name) - value_of(below, name)) / 31.4;
        EXPECT_NEAR(output.derivative[0], quotient, 2e-3 * std::abs(quotient)) << name;
      }
}

} // namespace
} // namespace gestell::tests
