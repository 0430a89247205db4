// Panels of curves over a logarithmic abscissa.

#include "apps/output/charts/log_chart.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace gestell::tests
{
namespace
{

using namespace apps;

LogChart chart_of(const LogCurve &curve)
{
  LogChart chart;
  chart.title   = "a & b";
  chart.x_begin = 1.;
  chart.x_end   = 100.;
  chart.panels  = {{"panel", {curve}}};
  return chart;
}

std::size_t count(const std::string &text, const std::string &part)
{
  std::size_t n = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++n;
  return n;
}

TEST(LogChart, EqualRatiosAreEqualDistances)
{
  const std::string svg = log_chart_svg(chart_of({"c", {1., 10., 100.}, {0., 0., 0.}, 0, false, true}));
  EXPECT_EQ(count(svg, "<circle"), 4u); // three and one in the legend
  std::vector<double> x;
  for (auto at = svg.find("<svg x="); (at = svg.find("cx=\"", at)) != std::string::npos; ++at)
    x.push_back(std::stod(svg.substr(at + 4)));
  ASSERT_EQ(x.size(), 3u);
  EXPECT_NEAR(x[2] - x[1], x[1] - x[0], 0.21); // each is kept to a tenth
}

TEST(LogChart, LinesBreakWhereThereIsNothing)
{
  const double      nan = std::nan("");
  const std::string svg =
      log_chart_svg(chart_of({"", {1., 2., 3., 4., 5.}, {0.1, 0.2, nan, 0.3, 0.4}, 0, false, false}));
  const auto at = svg.find("<path class=\"line s0\"");
  ASSERT_NE(at, std::string::npos);
  EXPECT_EQ(count(svg.substr(at, svg.find("/>", at) - at), "M"), 2u);
  EXPECT_NE(svg.find("a &amp; b"), std::string::npos);
}

TEST(LogChart, RefusesEmptyAxesAndUnequalLengths)
{
  LogChart chart = chart_of({"c", {1., 2.}, {1.}, 0, false, false});
  EXPECT_THROW(log_chart_svg(chart), std::invalid_argument);
  chart         = chart_of({"c", {1.}, {1.}, 0, false, false});
  chart.x_begin = 0.;
  EXPECT_THROW(log_chart_svg(chart), std::invalid_argument);
}

} // namespace
} // namespace gestell::tests
