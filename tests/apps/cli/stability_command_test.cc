// `gestell stability`: maps without a scene, and a scene's own modes laid over them.

#include "tests/support/csv_table.h"
#include "tests/support/program.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

TEST(StabilityCommand, WritesMapsOfAllMethods)
{
  const Folder folder("stability_maps");
  const Answer answer = gestell("stability --zeta 0,0.02" + folder.option());
  ASSERT_EQ(answer.exit_code, 0) << answer.text;
  const CsvTable maps((folder.results() / "stability_maps.csv").string());
  EXPECT_EQ(maps.rows() % 501, 0); // a hundred points a decade, five decades
  EXPECT_EQ(maps.rows() / 501, 2 * 24);
  const CsvTable intervals((folder.results() / "unstable_intervals.csv").string());
  EXPECT_NEAR(intervals.number("method", "BDF 3", "to omega h [1]"), std::sqrt(15.) / 2., 1e-9);
  for (const std::string name : {"spectral-radius", "period-error", "numerical-damping", "overshoot"})
    for (const std::string zeta : {"0", "0.02"})
      EXPECT_EQ(read(folder.results() / "charts" / ("stability-" + name + "-" + zeta + ".svg")).rfind("<svg", 0), 0u);
  const std::string page = read(folder.results() / "stability.html");
  EXPECT_NE(page.find("</html>"), std::string::npos);
  EXPECT_EQ(page.find("http", page.find("<body>")) == std::string::npos || page.find("src=\"http") == std::string::npos,
            true);
  EXPECT_EQ(page.find("src="), std::string::npos); // self-contained
  EXPECT_EQ(page.find("nan"), std::string::npos);
}

TEST(StabilityCommand, LaysTheModesOfASceneOverTheMaps)
{
  const Folder folder("stability_scene");
  expect_answer(gestell("stability " + scene("press_minimal.toml") +
                        " --set run.method=bdf --set run.order=3 --set run.step=1e-3" + folder.option()),
                0, {"BDF 3", "average acceleration"});
  const CsvTable modes((folder.results() / "stability_modes.csv").string());
  ASSERT_GT(modes.rows(), 0);
  for (int i = 0; i < modes.rows(); ++i)
  {
    EXPECT_NEAR(modes.number(i, "omega h [1]"), 2. * M_PI * modes.number(i, "frequency [Hz]") * 1e-3,
                1e-12 * modes.number(i, "omega h [1]"));
    EXPECT_EQ(modes.number(i, "unstable"), modes.number(i, "spectral radius [1]") > 1. + 1e-10 ? 1. : 0.);
  }
}

TEST(StabilityGuard, StopsARunThatWouldGrowUnlessItIsForced)
{
  const Folder      folder("stability_guard");
  const std::string run = "run " + scene("press_minimal.toml") +
                          " --set run.method=bdf --set run.order=3 --set run.step=1.3e-3 --set run.end=0.02" +
                          folder.option();
  const Answer refused = gestell(run); // 123 Hz with 3.7 %: omega h = 1
  expect_answer(refused, 2, {"unstable", "Hz, damping ratio", "run.force_unstable"});

  const Answer forced = gestell(run + "--set run.force_unstable=true");
  EXPECT_NE(forced.exit_code, 2) << forced.text;
  EXPECT_NE(read(folder.results() / "summary.json").find("unstable"), std::string::npos);
}

TEST(StabilityCommand, RefusesWhatItCannotShow)
{
  const Folder folder("stability_bad");
  EXPECT_EQ(gestell("stability --zeta -0.1" + folder.option()).exit_code, 2);
  EXPECT_EQ(gestell("stability no_such_scene.toml" + folder.option()).exit_code, 2);
  EXPECT_EQ(gestell("stability --step 0" + folder.option()).exit_code, 2);
  EXPECT_FALSE(std::filesystem::exists(folder.results()));
}

} // namespace
} // namespace gestell::tests
