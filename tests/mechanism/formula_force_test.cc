#include "mechanism/elements/formula_force.h"

#include "mechanism/elements/cubic_spring.h"
#include "tests/support/element_probe.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace mechanism;

const Formula t = Formula::variable(FormulaForce::time), u = Formula::variable(FormulaForce::displacement),
              v = Formula::variable(FormulaForce::rate);

TEST(FormulaForce, IsTheCubicSpringOfItsFormula)
{
  const FormulaForce formula({-(900. * u) - 5e6 * power(u, 3.)});
  const CubicSpring  spring({900., 5e6});
  for (const double at : {-0.02, 0., 1e-3, 0.05})
  {
    const Probe          probe = probe1(at, 0.3);
    const TangentWeights w{1., 2e3, 4e6};
    double               p, dp, expected, slope, K, D, K_expected, D_expected;
    formula.tangent(probe.motion(), nullptr, w, &p, &dp);
    spring.tangent(probe.motion(), nullptr, w, &expected, &slope);
    EXPECT_NEAR(p, expected, 1e-15 * std::abs(expected)); // two sums of the same terms
    EXPECT_NEAR(dp, slope, 1e-15 * std::abs(slope) * 2.);
    formula.engaged(&at, &K, &D);
    spring.engaged(&at, &K_expected, &D_expected);
    EXPECT_DOUBLE_EQ(K, K_expected);
    EXPECT_EQ(D, D_expected);
  }
}

TEST(FormulaForce, HasExactDerivativesToMotionAndRate)
{
  const FormulaForce formula({u * v * t + applied(Function::tanh, v / 0.2)});
  const Probe        probe = probe1(0.4, 0.1); // t = 0.3
  double             p, of_u, of_v;
  formula.derivatives(probe.motion(), nullptr, &p, &of_u, &of_v);
  const double h = std::tanh(0.5);
  EXPECT_NEAR(p, 0.4 * 0.1 * 0.3 + h, 1e-15);
  EXPECT_NEAR(of_u, 0.1 * 0.3, 1e-16);
  EXPECT_NEAR(of_v, 0.4 * 0.3 + (1. - h * h) / 0.2, 1e-14);
  EXPECT_NEAR(formula.quantity(0, probe.motion(), nullptr), p, 1e-15);
  EXPECT_EQ(formula.quantity(1, probe.motion(), nullptr), 0.4);
  EXPECT_EQ(formula.quantity(2, probe.motion(), nullptr), 0.1);
}

TEST(FormulaForce, StartsOnTheSideItGoesTo)
{
  const FormulaForce formula({abs(u) + abs(v)});
  EXPECT_EQ(started(formula, probe1(0., 0.1, -3.)).head(2), Eigen::Vector2d(1., 1.));
  EXPECT_EQ(started(formula, probe1(0., -0.1)).head(2), Eigen::Vector2d(-1., -1.));
  EXPECT_EQ(started(formula, probe1(0.2, 0., -3.)).head(2), Eigen::Vector2d(1., -1.));
}

TEST(FormulaForce, StartsOnTheSideOfKinksThatDependOnOthers)
{
  // |u| = 3 at u = -3: the argument of the condition is 2 only once |u| is on its side.
  const FormulaForce formula({conditional(abs(u) - 1., Relation::above, abs(v), abs(t - 9.))});
  EXPECT_EQ(started(formula, probe1(-3., -1.)).head(3), Eigen::Vector3d(-1., 1., -1.));
}

TEST(FormulaForce, SetsTheKinksThatComeIntoPlay)
{
  const FormulaForce formula({conditional(u, Relation::below, 0., 5. * abs(v))});
  Eigen::VectorXd    history = started(formula, probe1(-1., 3.));
  EXPECT_EQ(history[0], -1.);
  const Probe back = probe1(-1., -3.);
  EXPECT_LT(past(formula, 1, back, history.data()), 0.); // abs(v) rests: open whatever v does
  formula.transition(0, probe1(0., -3.).motion(true), history.data());
  EXPECT_EQ(history[0], 1.);
  EXPECT_EQ(history[1], -1.);
}

TEST(FormulaForce, IsNotANumberOnceARootHasLeftItsRangeForGood)
{
  const FormulaForce hertz({-5e6 * power(max(u, 0.), 1.5)}), chord({power(0.01 - abs(u), 0.5)});
  const Probe        outside = probe1(-0.02, -1.);
  Eigen::VectorXd    history = started(hertz, probe1(0.005, -1.));
  EXPECT_GT(force(hertz, outside, history.data(), true)[0], 0.); // a trial beyond the kink
  hertz.accept(outside.motion(true), history.data());
  EXPECT_TRUE(std::isfinite(force(hertz, outside, history.data(), true)[0]));

  history = started(chord, probe1(-0.005, -1.));
  EXPECT_LT(force(chord, outside, history.data(), true)[0], 0.);
  chord.accept(outside.motion(true), history.data());
  EXPECT_TRUE(std::isnan(force(chord, outside, history.data(), true)[0]));
}

TEST(FormulaForce, TellsItsStiffestBranch)
{
  // Two walls and a damper beyond one of them, all open at 0.
  const FormulaForce formula({-2e4 * max(u - 0.1, 0.) - 3e4 * min(u + 0.2, 0.) - 50. * step(u - 0.3) * v});
  const double       at = 0.;
  double             K, D;
  formula.engaged(&at, &K, &D);
  EXPECT_EQ(K, 0.);
  EXPECT_EQ(D, 0.);
  formula.stiffest(&at, &K, &D);
  EXPECT_DOUBLE_EQ(K, 5e4);
  EXPECT_DOUBLE_EQ(D, 50.);
}

TEST(FormulaForce, CallsAnglesAndTorquesByTheirNames)
{
  EXPECT_EQ(FormulaForce({u}).quantities()[0].unit, "N");
  EXPECT_EQ(FormulaForce({u, FormulaForce::Along::angle}).quantities()[0].name, "torque");
  EXPECT_EQ(FormulaForce({u, FormulaForce::Along::angle}).quantities()[2].unit, "rad/s");
}

TEST(FormulaForce, RefusesAVariableItDoesNotHave)
{
  EXPECT_THROW(FormulaForce({Formula::variable(3)}), std::invalid_argument);
}

} // namespace
} // namespace gestell::tests
