// Scenes beside each other, and the story of a run, by the program.

#include "tests/support/program.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

TEST(CompareOption, OfModesWritesPairsAndTheirPicture)
{
  const Folder folder("compare_modes");
  expect_answer(gestell("modes " + scene("press_minimal.toml") + " --compare " + scene("press_minimal_light.toml") +
                        folder.option()),
                0, {"matched by 5 shared measures", "84.6758", "97.9343", "energy of the coupled modes"});
  for (const char *file : {"compared_modes.csv", "mac.csv", "mode_energies.csv", "charts/modes-compared.svg"})
    EXPECT_TRUE(std::filesystem::exists(folder.results() / file)) << file;
  EXPECT_NE(read(folder.results() / "report.html").find("<section id=\"compared-modes\""), std::string::npos);
}

TEST(CompareOption, OfARunDrawsBothAndReportsItsLoads)
{
  const Folder      folder("compare_run");
  const std::string press = scene("press_minimal.toml");
  expect_answer(
      gestell("run " + press + " --set run.step='\"50 us\"' --compare " + press + folder.option()), 0,
      {"compared with press_minimal", "F_u: above 1 % of its peak from 0.194", "oscillations through a clearance"});
  const std::string report = read(folder.results() / "report.html");
  for (const char *id : {"compared-run", "compared-modes", "story"})
    EXPECT_NE(report.find("<section id=\"" + std::string(id) + "\""), std::string::npos) << id;
  EXPECT_TRUE(std::filesystem::exists(folder.results() / "compared_history.csv"));
  EXPECT_NEAR(json_number(read(folder.results() / "summary.json"), {"compared_run", "F_P", "ratio"}), 1., 1e-3);
}

TEST(CompareOption, RefusesOddInputWithTheWayOut)
{
  const Folder      folder("compare_odd");
  const std::string press = scene("press_minimal.toml"), crane = scene("crane_minimal.toml");
  const auto        refused = [&](const std::string &ask, const std::vector<std::string> &words)
  {
    expect_answer(gestell(ask + folder.option()), 2, words);
    EXPECT_FALSE(std::filesystem::exists(folder.results() / "summary.json"));
  };
  refused("modes " + press + " --compare " + crane,
          {"have no body, interface or element of the same name", "crank.angle", "boom.angle", "use the same name"});
  refused("run " + press + " --compare " + crane,
          {"no signal of the same name and unit", "F_P [N]", "[output.signals]"});
  refused("modes " + press + " --compare nowhere.toml", {"--compare", "nowhere.toml"});
  refused("modes " + press + " --compare " + folder.file("odd.toml", "name = 3"), {"odd.toml"});
}

} // namespace
} // namespace gestell::tests
