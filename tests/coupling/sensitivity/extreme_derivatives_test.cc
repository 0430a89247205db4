// Which extremes have derivatives, and which of the values about an event they are of.

#include "coupling/sensitivity/extreme_derivatives.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace
{

using namespace gestell::coupling;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

constexpr double near = 1e-9, length = 1., way = 1e-5, step = 1e-3;

/// One parameter of value 2.
std::vector<ParameterTwins> one_parameter()
{
  ParameterTwins twins;
  twins.value = 2.;
  return std::vector<ParameterTwins>{twins};
}

class Extremes : public ::testing::Test
{
protected:
  /// Of a signal that is smallest at 0.2 and largest at 0.6.
  ExtremeDerivatives of(double smallest, double largest) const
  {
    RunResult run;
    run.signals = {{"y", "N", smallest, 0.2, largest, 0.6, 0.}};
    return ExtremeDerivatives(run, twins_, near, length);
  }
  Told        told(double y, double dy) const { return {VectorXd::Constant(1, y), MatrixXd::Constant(1, 1, dy)}; }
  SignalRates rates(double rate, double second, double d_rate) const
  {
    return {VectorXd::Constant(1, rate), VectorXd::Constant(1, second), MatrixXd::Constant(1, 1, d_rate)};
  }

  std::vector<ParameterTwins> twins_ = one_parameter();
};

TEST_F(Extremes, AreOfTheSideOfAJumpWhoseValueTheyHave)
{
  // The signal falls from 5 to -3 and rises from there: the smallest value is that behind, told by a method whose
  // accelerations err by a millionth.
  auto           extremes = of(-3., 9.);
  const VectorXd flat     = VectorXd::Zero(1);
  extremes.at_event(0.2, told(5., 70.), flat, RowVectorXd::Constant(1, 0.5));
  extremes.at_event(0.2, told(-3. + 3e-6, 11.), flat, RowVectorXd::Constant(1, 0.5));
  EXPECT_EQ(extremes.take()[0].derivative[0], 11.);

  // The same from the other side: what lies behind does not take the place of what fits.
  auto others = of(-3., 9.);
  others.at_event(0.2, told(-3. - 3e-6, 70.), flat, RowVectorXd::Constant(1, 0.5));
  others.at_event(0.2, told(5., 11.), flat, RowVectorXd::Constant(1, 0.5));
  EXPECT_EQ(others.take()[0].derivative[0], 70.);
}

TEST_F(Extremes, ThatAreZeroButForRoundingHaveNone)
{
  auto extremes = of(-4e-12, 9.);
  extremes.at_turn(0.2, told(-4e-12, 5e3), rates(0., 1e3, 2.), way, step);
  const auto outputs = extremes.take();
  EXPECT_TRUE(std::isnan(outputs[0].derivative[0]));
  EXPECT_TRUE(std::isnan(outputs[1].derivative[0]));
  EXPECT_TRUE(outputs[0].is_zero);
  EXPECT_THAT(outputs[0].note, ::testing::HasSubstr("zero but for rounding"));
}

TEST_F(Extremes, AtAnEventThatAreZeroButForItsLocationHaveNone)
{
  // A force of 19.6 kN is told as -2.5e-5 N where its contact ends.
  const VectorXd slope    = VectorXd::Constant(1, 6e7);
  auto           extremes = of(-2.5e-5, 19613.);
  extremes.at_event(0.2, told(-2.5e-5, -2e7), slope, RowVectorXd::Constant(1, 0.5));
  const auto outputs = extremes.take();
  EXPECT_TRUE(std::isnan(outputs[0].derivative[0]));
  EXPECT_TRUE(std::isnan(outputs[1].derivative[0]));
  EXPECT_TRUE(outputs[0].is_zero);
  EXPECT_THAT(outputs[0].note, ::testing::HasSubstr("located"));

  // Where the signal turns, the value is as exact as the motion, and a percentage of it is none.
  auto turning = of(-2.5e-5, 19613.);
  turning.at_turn(0.2, told(-2.5e-5, 3.), rates(0., 1e9, 2.), way, step);
  const auto turned = turning.take();
  EXPECT_EQ(turned[0].derivative[0], 3.);
  EXPECT_TRUE(turned[0].is_zero);
}

TEST_F(Extremes, ThatALawMakesExactlyZeroHaveOne)
{
  auto extremes = of(0., 9.);
  extremes.at_event(0.2, told(0., 0.), VectorXd::Zero(1), RowVectorXd::Zero(1));
  EXPECT_EQ(extremes.take()[0].derivative[0], 0.);
}

TEST_F(Extremes, MoveByTheirSlopeOverTheirCurvature)
{
  auto extremes = of(-3., 9.);
  extremes.at_turn(0.6, told(9., 4.), rates(0., -50., 2.), way, step);
  const auto outputs = extremes.take();
  EXPECT_EQ(outputs[2].derivative[0], 4.);
  EXPECT_DOUBLE_EQ(outputs[3].derivative[0], 2. / 50.);
}

TEST_F(Extremes, OfFlatPeaksHaveAValueButNoInstant)
{
  // y'' of 1e-13 of 9 over the square of the way is rounding; a signal that turns the other way, or beyond a step, is
  // no peak by its curvature.
  const double rounding = 9. * 1e-13 / (way * way);
  for (const auto &[rate, second] : {std::pair(0., -rounding), std::pair(0., 50.), std::pair(0.2, -50.)})
  {
    auto extremes = of(-3., 9.);
    extremes.at_turn(0.6, told(9., 4.), rates(rate, second, 2.), way, step);
    const auto outputs = extremes.take();
    EXPECT_EQ(outputs[2].derivative[0], 4.);
    EXPECT_TRUE(std::isnan(outputs[3].derivative[0]));
    EXPECT_THAT(outputs[3].note, ::testing::HasSubstr("flat"));
  }
}

TEST_F(Extremes, WhoseInstantOnePercentMovesOutOfTheRunHaveNoInstant)
{
  // 0.01 2 x 2/0.03 = 1.3 runs
  auto extremes = of(-3., 9.);
  extremes.at_turn(0.6, told(9., 4.), rates(0., -0.03, 2.), 1e-3, step);
  const auto outputs = extremes.take();
  EXPECT_TRUE(std::isnan(outputs[3].derivative[0]));
  EXPECT_THAT(outputs[3].note, ::testing::HasSubstr("more than the run"));
}

} // namespace
