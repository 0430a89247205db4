// Which extremes have derivatives, and which of the values about an event they are of.

#include "coupling/sensitivity/extreme_derivatives.h"
#include "tests/support/test.h"

#include <tuple>

namespace
{

using namespace gestell::coupling;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

constexpr double near = 1e-9, length = 1., step = 1e-3;

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
    return ExtremeDerivatives(run, twins_, 0., near, length);
  }
  Told reported(double y, double dy) const { return {VectorXd::Constant(1, y), MatrixXd::Constant(1, 1, dy)}; }
  /// @param off  error of the second derivative
  Turn turn(double dy, double rate, double second, double d_rate, double off = 0., Kink kink = Kink::none) const
  {
    return {rate, second, off, VectorXd::Constant(1, dy), VectorXd::Constant(1, d_rate), kink, -60., 80.};
  }

  std::vector<ParameterTwins> twins_ = one_parameter();
};

TEST_F(Extremes, AreOfTheSideOfAJumpWhoseValueTheyHave)
{
  // The signal falls from 5 to -3 and rises from there: the smallest value is that behind, told by a method whose
  // accelerations err by a millionth.
  auto           extremes = of(-3., 9.);
  const VectorXd flat     = VectorXd::Zero(1);
  extremes.at_event(0.2, reported(5., 70.), flat, RowVectorXd::Constant(1, 0.5));
  extremes.at_event(0.2, reported(-3. + 3e-6, 11.), flat, RowVectorXd::Constant(1, 0.5));
  EXPECT_EQ(extremes.take()[0].derivative[0], 11.);

  // The same from the other side: what lies behind does not take the place of what fits.
  auto others = of(-3., 9.);
  others.at_event(0.2, reported(-3. - 3e-6, 70.), flat, RowVectorXd::Constant(1, 0.5));
  others.at_event(0.2, reported(5., 11.), flat, RowVectorXd::Constant(1, 0.5));
  EXPECT_EQ(others.take()[0].derivative[0], 70.);
}

TEST_F(Extremes, ThatAreZeroButForRoundingHaveNone)
{
  auto extremes = of(-4e-12, 9.);
  extremes.at_turn(0.2, 0, turn(5e3, 0., 1e3, 2.), step);
  const auto outputs = extremes.take();
  EXPECT_TRUE(std::isnan(outputs[0].derivative[0]));
  EXPECT_TRUE(std::isnan(outputs[1].derivative[0]));
  EXPECT_TRUE(outputs[0].is_zero);
  EXPECT_THAT(outputs[0].note, ::testing::HasSubstr("zero within rounding"));
}

TEST_F(Extremes, AtAnEventThatAreZeroButForItsLocationHaveNone)
{
  // A force of 19.6 kN is told as -2.5e-5 N where its contact ends.
  const VectorXd slope    = VectorXd::Constant(1, 6e7);
  auto           extremes = of(-2.5e-5, 19613.);
  extremes.at_event(0.2, reported(-2.5e-5, -2e7), slope, RowVectorXd::Constant(1, 0.5));
  const auto outputs = extremes.take();
  EXPECT_TRUE(std::isnan(outputs[0].derivative[0]));
  EXPECT_TRUE(std::isnan(outputs[1].derivative[0]));
  EXPECT_TRUE(outputs[0].is_zero);
  EXPECT_THAT(outputs[0].note, ::testing::HasSubstr("the accuracy of its event"));

  // Where the signal turns, the value is as exact as the motion, and a percentage of it is none.
  auto turning = of(-2.5e-5, 19613.);
  turning.at_turn(0.2, 0, turn(3., 0., 1e9, 2.), step);
  const auto turned = turning.take();
  EXPECT_EQ(turned[0].derivative[0], 3.);
  EXPECT_TRUE(turned[0].is_zero);
}

TEST_F(Extremes, ThatALawMakesExactlyZeroHaveOne)
{
  auto extremes = of(0., 9.);
  extremes.at_event(0.2, reported(0., 0.), VectorXd::Zero(1), RowVectorXd::Zero(1));
  EXPECT_EQ(extremes.take()[0].derivative[0], 0.);
}

TEST_F(Extremes, MoveByTheirSlopeOverTheirCurvature)
{
  auto extremes = of(-3., 9.);
  extremes.at_turn(0.6, 0, turn(4., 0., -50., 2.), step);
  const auto outputs = extremes.take();
  EXPECT_EQ(outputs[2].derivative[0], 4.);
  EXPECT_DOUBLE_EQ(outputs[3].derivative[0], 2. / 50.);
}

TEST_F(Extremes, WhoseCurvatureIsNotKnownHaveAValueButNoInstant)
{
  // y'' that is not known; a signal that turns the other way, or beyond a step, is no peak by its curvature; one is
  // flat that its curvature changes by less than 1e-4 of its size, 9, over the whole run.
  for (const auto &[rate, second, off, why] :
       {std::tuple(0., -50., 0.02, "lost in rounding"), std::tuple(0., 50., 0., "lost in rounding"),
        std::tuple(0.2, -50., 0., "farther than a step"), std::tuple(0., -8e-4, 1e-3, "flat")})
  {
    auto extremes = of(-3., 9.);
    extremes.at_turn(0.6, 0, turn(4., rate, second, 2., off), step);
    const auto outputs = extremes.take();
    EXPECT_EQ(outputs[2].derivative[0], 4.);
    EXPECT_TRUE(std::isnan(outputs[3].derivative[0]));
    EXPECT_THAT(outputs[3].note, ::testing::HasSubstr(why));
  }
}

TEST_F(Extremes, WhoseRateChangesByRoundingHaveNoInstant)
{
  // Of dt = 2/50 an error of 1e-5 is 2.5e-4 of it, and 2e-5 of the run by the value of 2; of 1e-7 it is neither.
  for (const double off : {50e-5, 50e-7})
  {
    auto extremes = of(-3., 9.);
    Turn at       = turn(4., 0., -50., 2.);
    at.d_off      = VectorXd::Constant(1, off);
    extremes.at_turn(0.6, 0, at, step);
    const auto outputs = extremes.take();
    EXPECT_EQ(outputs[2].derivative[0], 4.);
    EXPECT_EQ(std::isnan(outputs[3].derivative[0]), off > 1e-4);
    EXPECT_EQ(outputs[3].note.empty(), off < 1e-4);
  }
}

TEST_F(Extremes, WhereTheSignalDoesNotTurnHaveNone)
{
  // At a corner y'' is not known; a signal that still falls by 1 % of its size in a step does not turn.
  const auto reason = [&](const Turn &at)
  {
    auto extremes = of(-3., 9.);
    extremes.at_turn(0.6, 0, at, step);
    const auto outputs = extremes.take();
    EXPECT_TRUE(std::isnan(outputs[2].derivative[0]));
    EXPECT_TRUE(std::isnan(outputs[3].derivative[0]));
    EXPECT_EQ(outputs[2].note, outputs[3].note);
    return outputs[2].note;
  };
  EXPECT_THAT(reason(turn(4., 10., 1e6, 2., 8e5, Kink::corner)), ::testing::HasSubstr("rate goes from -60 to 80"));
  EXPECT_THAT(reason(turn(4., 10., 1e6, 2., 8e5, Kink::jump)), ::testing::HasSubstr("jumps"));
  EXPECT_THAT(reason(turn(4., -90., -50., 2.)), ::testing::HasSubstr("its rate is -90"));
}

TEST_F(Extremes, WhoseInstantOnePercentMovesOutOfTheRunHaveNoInstant)
{
  // 0.01 2 x 2/0.03 = 1.3 runs
  auto extremes = of(-3., 9.);
  extremes.at_turn(0.6, 0, turn(4., 0., -0.03, 2.), step);
  const auto outputs = extremes.take();
  EXPECT_TRUE(std::isnan(outputs[3].derivative[0]));
  EXPECT_THAT(outputs[3].note, ::testing::HasSubstr("more than the run"));
}

} // namespace
