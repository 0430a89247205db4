#include "apps/analysis/frf/frequency_response.h"
#include "apps/analysis/periodic/periodic_charts.h"
#include "apps/analysis/periodic/periodic_description.h"
#include "apps/analysis/periodic/periodic_headline.h"
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

/// Amplitude and stability over the range: stable, unstable, stable again, and of another branch.
TEST(PeriodicHeadline, TellsTheLargestValueAndWhereMotionsAreStable)
{
  PeriodicResult result;
  result.parameter      = "parameters.n";
  result.parameter_unit = "1/min";
  for (const auto &[n, multiplier, branch] :
       {std::tuple(200., 0.5, 1), {300., 0.5, 1}, {400., 1.5, 1}, {500., 0.5, 1}, {500., 0.5, 2}, {450., 0.5, 2}})
  {
    PeriodicEntry entry;
    entry.parameter            = n;
    entry.branch               = branch;
    entry.solution.multipliers = Eigen::VectorXcd::Constant(1, multiplier);
    entry.signals              = {spectrum("F", {1.}), spectrum("G", {1.})};
    entry.signals[0].max       = 10. * n;
    entry.signals[0].min       = -1e6 / n;
    result.entries.push_back(entry);
  }
  const Headline headline = headline_of(result);
  EXPECT_EQ(headline.sentence, "6 periodic solutions with parameters.n from 200 to 500 1/min: 5 stable, 1 unstable.");
  ASSERT_EQ(headline.numbers.size(), 2u) << "of signals of one unit the first";
  EXPECT_EQ(headline.numbers[0].value, "200 to 300, 500, 450 to 500 1/min");
  EXPECT_EQ(headline.numbers[1].value, "-5 kN");
  EXPECT_EQ(headline.numbers[1].meaning, "largest F, at 200 1/min");
  EXPECT_THAT(headline_of(PeriodicResult()).sentence, StartsWith("No periodic solution was found"));
}

TEST(FrfHeadline, IsTheHighestPeakOfEachPair)
{
  FrequencyResponse response;
  response.kind           = "receptance";
  response.frequencies_hz = {1., 100.};
  response.pairs.resize(2);
  for (ResponsePair &pair : response.pairs)
    pair.from = "a", pair.unit = "m/N";
  response.pairs[0].to    = "b";
  response.pairs[1].to    = "c";
  response.pairs[0].peaks = {{10., 1e-3, 0.01}, {20., 2e-3, 0.01}};
  const Headline headline = headline_of(response);
  ASSERT_EQ(headline.numbers.size(), 2u);
  EXPECT_EQ(headline.numbers[0].value, "0.002 m/N at 20 Hz");
  EXPECT_EQ(headline.numbers[0].meaning, "b/a, highest of 2 peaks");
  EXPECT_EQ(headline.numbers[1].value, "no peak");
  EXPECT_THAT(headline.html(), HasSubstr("<strong>0.002 m/N at 20 Hz</strong>"));
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
