#include "apps/output/charts/chart.h"
#include "apps/output/charts/signal_charts.h"
#include "tests/support/output_example.h"
#include "tests/support/test.h"

using namespace gestell;
using namespace gestell::apps;

namespace
{

/// Number of points of the longest path of a picture.
std::size_t longest_path(const std::string &svg)
{
  std::size_t longest = 0;
  for (std::size_t i = svg.find(" d=\""); i != std::string::npos; i = svg.find(" d=\"", i + 4))
  {
    const std::string path = svg.substr(i + 4, svg.find('"', i + 4) - i - 4);
    longest = std::max<std::size_t>(longest, std::count_if(path.begin(), path.end(), [](char c) { return c == 'L'; }));
  }
  return longest;
}

std::size_t count(const std::string &text, const std::string &part)
{
  std::size_t n = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++n;
  return n;
}

/// Smallest ordinate (the highest place) the first curve reaches.
double highest_place(const std::string &svg)
{
  const std::size_t  start = svg.find("d=\"M", svg.find("<path class=\"line s0", svg.find("<svg", 1))) + 3;
  std::string        path  = svg.substr(start, svg.find('"', start) - start);
  std::istringstream points(path);
  double             highest = 1e300, x, y;
  for (char pen; points >> pen >> x >> y;)
    highest = std::min(highest, y);
  return highest;
}

Chart wave(int n)
{
  Chart chart;
  chart.title = "wave";
  chart.panels[0].add({"y"});
  for (int i = 0; i < n; ++i)
    chart.panels[0].curves[0].add(i / (n - 1.), std::sin(40. * i / (n - 1.)));
  return chart;
}

coupling::RunResult two_columns(const std::string &unit, double span1, double span2)
{
  coupling::RunResult run;
  run.columns = {"t", "a", "b"};
  run.units   = {"s", unit, unit};
  for (int i = 0; i <= 400; ++i)
    run.rows.insert(run.rows.end(), {0.01 * i, span1 * std::sin(0.1 * i), span2 * std::cos(0.1 * i)});
  return run;
}

} // namespace

TEST(Ticks, AreMultiplesOfOneTwoOrFiveTimesAPowerOfTen)
{
  for (const double span : {1e-9, 3.3e-4, 0.45, 7., 1656., 9e12})
  {
    const auto ticks = nice_ticks(-0.3 * span, 0.7 * span, 6);
    ASSERT_GE(ticks.size(), 3u) << span;
    ASSERT_LE(ticks.size(), 11u) << span;
    const double step     = ticks[1] - ticks[0];
    const double mantissa = step / std::pow(10., std::floor(std::log10(step) + 1e-9));
    EXPECT_LT(std::min({std::abs(mantissa - 1.), std::abs(mantissa - 2.), std::abs(mantissa - 5.)}), 1e-6) << step;
    for (const double x : ticks)
      EXPECT_NEAR(x / step, std::round(x / step), 1e-6);
  }
  EXPECT_TRUE(nice_ticks(1., 1., 5).empty());
}

TEST(Chart, KeepsAPeakOfASingleRowOfALongHistory)
{
  Chart                chart   = wave(45000);
  std::vector<double> &y       = chart.panels[0].curves[0].y;
  const double         regular = y[20011];
  const double         before  = highest_place(chart_svg(chart));
  y[20011]                     = 2.;
  const std::string with_peak  = chart_svg(chart);
  y[20011]                     = regular;
  y.back()                     = 2.;
  const std::string at_the_end = chart_svg(chart);
  EXPECT_NEAR(highest_place(with_peak), highest_place(at_the_end), 0.11); // coordinates have one decimal
  EXPECT_NEAR(before, highest_place(with_peak), 8.);                      // the scale follows the peak
  EXPECT_LE(longest_path(with_peak), 4u * 640u);
}

TEST(Chart, WritesOfALongHistoryOnlyWhatItsWindowShows)
{
  Chart chart   = wave(45000);
  chart.x.begin = 0.5;
  chart.x.end   = 0.501;
  EXPECT_LE(longest_path(chart_svg(chart)), 50u);
}

TEST(Chart, DrawsWhatIsConstantEmptyOrBroken)
{
  Chart                chart = wave(10);
  std::vector<double> &y     = chart.panels[0].curves[0].y;
  std::fill(y.begin(), y.end(), 3.);
  EXPECT_EQ(chart_svg(chart).find("nan"), std::string::npos);
  y[4]                  = std::nan("");
  const std::string svg = chart_svg(chart);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  const auto at = svg.find("<path class=\"line s0");
  EXPECT_EQ(count(svg.substr(at, svg.find("/>", at) - at), "M"), 2u); // two pieces
  EXPECT_EQ(chart_svg(Chart()).find("nan"), std::string::npos);
}

TEST(Chart, EqualRatiosAreEqualDistancesOnALogarithmicAxis)
{
  Chart chart;
  chart.x                = {"x", 1., 100., Scale::logarithmic};
  chart.panels[0].curves = {rings("c", 0)};
  for (const double x : {1., 10., 100.})
    chart.panels[0].curves[0].add(x, 0.);
  const std::string svg = chart_svg(chart);
  EXPECT_EQ(count(svg, "<circle"), 4u); // three and one in the legend
  std::vector<double> x;
  for (auto at = svg.find("cx=\""); at != std::string::npos; at = svg.find("cx=\"", at + 1))
    x.push_back(std::stod(svg.substr(at + 4)));
  EXPECT_NEAR(x[2] - x[1], x[1] - x[0], 0.21); // each is kept to a tenth
}

TEST(Chart, RefusesEmptyAxesAndUnequalLengths)
{
  Chart chart = wave(10);
  chart.panels[0].curves[0].y.pop_back();
  EXPECT_THROW(chart_svg(chart), std::invalid_argument);
  chart   = wave(10);
  chart.x = {"x", 0., 1., Scale::logarithmic};
  EXPECT_THROW(chart_svg(chart), std::invalid_argument);
}

TEST(Chart, EscapesNamesOfTheUser)
{
  Chart chart                    = wave(10);
  chart.panels[0].curves[0].name = "F<\"P\"> & co";
  EXPECT_NE(chart_svg(chart).find("F&lt;&quot;P&quot;&gt; &amp; co"), std::string::npos);
}

TEST(SignalCharts, ShareAnAxisOnlyWhereBothSignalsCanBeRead)
{
  EXPECT_EQ(group_signals(two_columns("N", 1e6, 2e5)).size(), 1u);
  const auto apart = group_signals(two_columns("m", 0.16, 6e-4));
  ASSERT_EQ(apart.size(), 2u);
  EXPECT_EQ(apart[0].columns, std::vector<std::size_t>{1});
  EXPECT_EQ(apart[1].columns, std::vector<std::size_t>{2});
}

TEST(SignalCharts, ShowTheMainShockEnlarged)
{
  const auto run          = *example_result(4500).run;
  const auto [begin, end] = main_shock(run);
  EXPECT_LT(begin, 0.24);
  EXPECT_GT(end, 0.26);
  EXPECT_NEAR(end - begin, 0.45 / 8., 1e-12);

  std::vector<std::string> names;
  for (const SignalChart &chart : signal_charts(run))
    names.push_back(chart.name);
  EXPECT_EQ(names, (std::vector<std::string>{"forces", "forces-shock", "displacements", "displacements-2", "energy"}));
}

/// A tool force breaks down at 0.2 s; the column it leaves ringing has the larger range and its fastest change at 0.6
/// s.
TEST(SignalCharts, ShowTheShockAndNotTheRingingItLeaves)
{
  coupling::RunResult run;
  run.columns = {"t", "tool", "column"};
  run.units   = {"s", "N", "N"};
  for (int i = 0; i <= 1000; ++i)
  {
    const double t = 1e-3 * i;
    run.rows.insert(run.rows.end(), {t, t < 0.2 ? 800. : 0.,
                                     500. * std::sin(40. * M_PI * t) * std::exp(-std::pow((t - 0.6) / 0.1, 2))});
  }
  const auto [begin, end] = main_shock(run);
  EXPECT_LT(begin, 0.2);
  EXPECT_GT(end, 0.2);
}

TEST(SignalCharts, LeaveAHistoryOfOneRowAlone)
{
  auto run = *example_result(300).run;
  run.rows.resize(run.columns.size());
  EXPECT_TRUE(signal_charts(run).empty());
}
