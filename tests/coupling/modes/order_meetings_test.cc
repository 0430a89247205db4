#include "coupling/modes/excitation_orders.h"
#include "tests/support/test.h"

namespace
{

using namespace gestell::coupling;

/// Frequencies of lines that are linear in the coordinate, at positions.
ModesAlong along(const std::vector<double> &positions, const std::vector<std::pair<double, double>> &lines)
{
  ModesAlong result;
  for (const double x : positions)
  {
    ModesAt at;
    at.x = x;
    for (const auto &[f_0, slope] : lines)
    {
      Mode mode;
      mode.frequency_hz = f_0 + slope * x;
      at.modes.push_back(mode);
    }
    result.positions.push_back(at);
  }
  result.free.assign(lines.size(), false);
  return result;
}

// The third order of 4 Hz meets 10 Hz + 1 Hz x at x = 2, between two positions far from it.
TEST(OrderMeetings, LieWhereALineCrossesAMultipleOfTheSpeedHoweverFarPositionsAreApart)
{
  const auto found = order_meetings(along({0., 1.5, 3.}, {{10., 1.}}), 4., 3, 1e-3);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].order, 3);
  EXPECT_EQ(found[0].line, 0);
  for (const double x : {found[0].x, found[0].begin, found[0].end})
    EXPECT_NEAR(x, 2., 1e-14);
  EXPECT_NEAR(found[0].frequency_hz, 12., 1e-13);
  EXPECT_EQ(found[0].distance, 0.);
}

// Within 5 % of 12 Hz the line is from 11.4 to 12.6 Hz, at x = 1.4 to 2.6.
TEST(OrderMeetings, ReachOverThePositionsInTheBand)
{
  const auto found = order_meetings(along({1., 1.4001, 1.9, 2.3, 2.7}, {{10., 1.}, {50., 0.}}), 4., 3, 0.05);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].begin, 1.4001);
  EXPECT_EQ(found[0].end, 2.3);
  EXPECT_NEAR(found[0].x, 2., 1e-14);
  EXPECT_NEAR(found[0].frequency_hz, 12., 1e-13);
}

TEST(OrderMeetings, AreNoneWithoutASpeed)
{
  EXPECT_TRUE(order_meetings(along({0., 1.5, 3.}, {{10., 1.}}), 0., 3, 0.1).empty());
}

} // namespace
