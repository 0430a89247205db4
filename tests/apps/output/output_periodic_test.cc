#include "apps/analysis/periodic/periodic_charts.h"
#include "apps/analysis/periodic/periodic_description.h"
#include "apps/analysis/periodic/periodic_tables.h"
#include "apps/output/describe/described_json.h"
#include "tests/support/test.h"

namespace gestell::apps
{
namespace
{

using ::testing::HasSubstr;
using ::testing::StartsWith;

SignalOrbit spectrum(const std::string &name, const std::vector<double> &amplitude)
{
  SignalOrbit signal;
  signal.name      = name;
  signal.unit      = "N";
  signal.amplitude = amplitude;
  return signal;
}

} // namespace

TEST(HarmonicsChart, DrawsFourSignalsWhoseSpectraDifferMostSideBySide)
{
  PeriodicEntry entry;
  entry.signals     = {spectrum("a", {1., 0., 0.}), spectrum("twice a", {2., 0., 0.}), spectrum("b", {0., 1., 0.}),
                       spectrum("c", {0., 0., 1.}), spectrum("rest", {0., 0., 0.}),    spectrum("all", {1., 1., 1.})};
  const Chart chart = harmonics_chart(entry, 1);
  EXPECT_EQ(chart.panels[0].curves.size(), 4u);
  EXPECT_EQ(not_barred(entry), "Not drawn: twice a, rest.");
  for (const Tile &one : chart.panels[0].tiles)
    for (const Tile &other : chart.panels[0].tiles)
      EXPECT_TRUE(&one == &other || one.x_end < other.x_begin || other.x_end < one.x_begin);
  EXPECT_THAT(chart_svg(chart), HasSubstr("all, 3: 1 N"));
}

TEST(AmplitudeChart, ShowsUnstableMotionsDashedAndTheBackboneDotted)
{
  PeriodicResult result;
  result.parameter = "parameters.n";
  for (const double multiplier : {0.5, 1.5})
  {
    PeriodicEntry entry;
    entry.parameter            = multiplier;
    entry.solution.multipliers = Eigen::VectorXcd::Constant(1, multiplier);
    entry.signals              = {spectrum("F", {2. * multiplier})};
    result.entries.push_back(entry);
  }
  EXPECT_EQ(amplitude_chart(result, 0).panels[0].curves.size(), 2u);
  result.backbone                    = {result.entries[0]};
  result.backbone[0].solution.period = 4.;
  const Json json                    = described_json(result)["backbone"][0];
  EXPECT_EQ(json["frequency_hz"], 0.25);
  EXPECT_EQ(json["amplitudes"]["F"], 1.);
  const Chart chart = amplitude_chart(result, 0);
  ASSERT_EQ(chart.panels[0].curves.size(), 3u);
  EXPECT_EQ(chart.panels[0].curves[1].line, LineStyle::dashed);
  EXPECT_EQ(chart.panels[0].curves[1].y.back(), 3.);
  EXPECT_EQ(chart.panels[0].curves[2].line, LineStyle::dotted);
}

/// Cells of one motion that lie side by side are one tile; those not looked at are left white and out of the table.
TEST(BasinsChart, JoinsCellsAndLeavesOutWhatWasNotLookedAt)
{
  BasinMap map{"x", "x'", {{0, 1, 0., 2., 0., 4., 2}, {{3, 0.5, 0.5}}, {}, {}, {}}};
  map.basins.motion  = (Eigen::Matrix2i() << 3, 0, 3, -1).finished();
  map.basins.periods = (Eigen::Matrix2i() << 7, 8, 9, 0).finished();
  const Chart chart  = basins_chart(map);
  ASSERT_EQ(chart.panels[0].tiles.size(), 1u);
  EXPECT_NEAR(chart.panels[0].tiles[0].x_end, 2., 0.1); // cells overlap a little
  EXPECT_NEAR(chart.panels[0].tiles[0].y_end, 2., 0.2);
  EXPECT_THAT(chart.panels[0].curves[0].name, StartsWith("no. 3, 66.7 %"));
  PeriodicResult result;
  EXPECT_EQ(std::string(basins_csv(result)), "");
  result.basins = map;
  EXPECT_EQ(std::string(basins_csv(result)), "x,x',solution,periods\n0.5,1,3,7\n1.5,1,3,9\n0.5,3,0,8\n");
  EXPECT_THAT(basins_text(map), HasSubstr("interrupted"));
  EXPECT_EQ(described_json(map)["complete"], false);
}

TEST(SectionTable, HasARowForEveryPeriodWithCoordinatesRatesAndSignals)
{
  PeriodicResult result;
  EXPECT_EQ(std::string(section_csv(result)), "");
  result.coordinates = {{"slide", -1.}}; // of a frame whose row is that of the opposite motion
  LongRun run;
  run.motion.kind    = "quasi-periodic";
  run.motion.periods = 64;
  run.motion.section = (Eigen::Matrix2d() << 1., 2., 3., 4.).finished();
  run.columns        = {"F [N]"};
  run.rows           = {5., 6.};
  result.long_run    = run;
  EXPECT_EQ(std::string(section_csv(result)), "period,slide,slide',F [N]\n64,-1,-3,5\n65,-2,-4,6\n");
  EXPECT_THAT(long_run_text(run), HasSubstr("quasi-periodic"));
  EXPECT_EQ(described_json(run.motion)["kind"], "quasi-periodic");
}

} // namespace gestell::apps
