// Angles on which nothing depends are free in a period, all others advance by what leaves the equations as they are;
// and a run finds out motions that close only because something else was assumed.

#include "coupling/periodic/periodic_methods.h"
#include "coupling/periodic/turn_increments.h"
#include "coupling/periodic/verified_orbit.h"
#include "tests/support/small_system.h"
#include "tests/support/test.h"

namespace
{

using namespace gestell::coupling;
using namespace gestell::tests;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Rotors and a base, with laws of one measure each.
class RotorTrain final : public SmallSystem
{
public:
  struct Element
  {
    VectorXd w;
    Law      p;
  };
  RotorTrain(const VectorXd &inertia, const MatrixXd &B, const MatrixXd &C, std::vector<Element> elements)
      : SmallSystem(inertia.asDiagonal(), B, C), elements_(std::move(elements))
  {
    MatrixXd directions(inertia.size(), Eigen::Index(elements_.size()));
    for (std::size_t i = 0; i < elements_.size(); ++i)
      directions.col(Eigen::Index(i)) = elements_[i].w;
    W = directions.sparseView();
  }
  std::vector<ForceBlock> blocks() const override
  {
    std::vector<ForceBlock> blocks;
    for (std::size_t i = 0; i < elements_.size(); ++i)
      blocks.push_back({int(i), 1});
    return blocks;
  }
  std::string element_of(int i) const override { return "element " + std::to_string(i); }
  Vector      save_history() const override { return {}; }
  void        restore_history(const Vector &) override {}
  void        force(const LocalState &state, Vector &p) const override
  {
    double du, dv;
    for (std::size_t i = 0; i < elements_.size(); ++i)
      elements_[i].p(state.u[i], state.v[i], p[i], du, dv);
  }
  void derivatives(const LocalState &state, Vector &p, Matrix &dp_du, Matrix &dp_dv) const override
  {
    for (std::size_t i = 0; i < elements_.size(); ++i)
      elements_[i].p(state.u[i], state.v[i], p[i], dp_du(i, i), dp_dv(i, i));
  }
  void tangent(const LocalState &state, double w_u, double w_v, double, Vector &p, Matrix &dp) const override
  {
    Matrix u = Matrix::Zero(p.size(), p.size()), v = u;
    derivatives(state, p, u, v);
    dp = w_u * u + w_v * v;
  }
  void tangent_blocks(const LocalState &state, double w_u, double w_v, double w_a, Vector &p,
                      Vector &blocks) const override
  {
    LocalForces::tangent_blocks(state, w_u, w_v, w_a, p, blocks);
  }

private:
  std::vector<Element> elements_;
};

const double speed = 30., rise = 0.4, brake = 0.05; // rad/s, N m s/rad

/// A torque that falls with the speed.
SmallSystem::Law motor()
{
  return [](double, double v, double &p, double &du, double &dv) { p = rise * (speed - v), du = 0., dv = -rise; };
}

/// The weight of a crank, amplitude sin u.
SmallSystem::Law weight(double amplitude)
{
  return [amplitude](double u, double, double &p, double &du, double &dv)
  { p = amplitude * std::sin(u), du = amplitude * std::cos(u), dv = 0.; };
}

/// Two rotors and a belt of stiffness c between them, whose ratio is i.
MatrixXd of_belt(double c, double i)
{
  const Eigen::Vector2d w(1., -i);
  return c * w * w.transpose();
}

/// A motor drives a wheel over a belt: round, or with a weight off its centre.
RotorTrain belt_drive(double i, double off = 0.)
{
  MatrixXd B = of_belt(0.3, i);
  B(1, 1) += brake;
  std::vector<RotorTrain::Element> elements = {{Eigen::Vector2d(1., 0.), motor()}};
  if (off != 0.)
    elements.push_back({Eigen::Vector2d(0., 1.), weight(off)});
  return RotorTrain(Eigen::Vector2d(0.02, 0.5), B, of_belt(80., i), elements);
}

PeriodicProblem train_problem(RotorTrain &system, std::vector<int> angles, const VectorXd &speeds, PeriodicGuess &guess,
                              double period = 0.)
{
  guess = {VectorXd::Zero(system.size()), speeds, 0.};
  const AngleInvariance invariance(system, std::move(angles), guess, 0.);
  const AngleIncrements found = increments_of(invariance, speeds, period, 0.01, system);
  EXPECT_EQ(found.refusal, "");
  EXPECT_EQ(invariance.changed_by(found.turn.head(Eigen::Index(invariance.angles().size()))), "");
  PeriodicProblem problem;
  problem.system = &system;
  problem.period = period > 0. ? period : found.period;
  problem.turn   = found.turn;
  problem.free   = found.free;
  problem.phase  = period > 0. ? -1 : found.phase;
  return problem;
}

class RatioOfBelt : public testing::TestWithParam<double>
{
};

} // namespace

/// Two round rotors: the motion is steady, its speeds and the stretch of the belt those of the balance of torques.
TEST_P(RatioOfBelt, LeavesRoundRotorsTheStretchOfTheirBalance)
{
  const double  i = GetParam(), omega = rise * speed / (rise + brake / (i * i)), torque = brake * omega / (i * i);
  RotorTrain    system = belt_drive(i);
  PeriodicGuess guess;
  // At the start the wheel rests: what turns it is found all the same.
  const PeriodicProblem problem = train_problem(system, {0, 1}, Eigen::Vector2d(28., 0.), guess);
  EXPECT_NEAR(problem.turn[0], i * problem.turn[1], 1e-12);
  guess.v = problem.turn / problem.period;
  for (const std::string method : {"shooting", "settling", "collocation", "harmonic-balance"})
  {
    auto found = periodic_method(method).solve(problem, guess, {});
    ASSERT_EQ(found.size(), 1u) << method;
    EXPECT_NEAR(found[0].v[0], omega, 1e-7 * omega) << method;
    EXPECT_NEAR(80. * (found[0].q[0] - i * found[0].q[1]), torque, 1e-7 * torque) << method;
    verify_stable(problem, found);
    EXPECT_TRUE(found[0].stable()) << method;
    EXPECT_EQ(found[0].verification.periods, verified_periods) << method;
    EXPECT_LT(found[0].verification.departure, 1e-7) << method;
  }
}

/// The wheel tells its turns now: in one of them the motor turns i times, no whole number.
TEST_P(RatioOfBelt, IsHowFarTheMotorTurnsInATurnOfACrank)
{
  const double          i      = GetParam();
  RotorTrain            system = belt_drive(i, 0.8);
  PeriodicGuess         guess;
  const PeriodicProblem problem = train_problem(system, {0, 1}, Eigen::Vector2d(28., 28. / i), guess);
  EXPECT_NEAR(problem.turn[1], 2. * M_PI, 1e-12);
  EXPECT_NEAR(problem.turn[0], 2. * M_PI * i, 1e-11);
  EXPECT_EQ(problem.phase, 1);
  EXPECT_FALSE(problem.has_free_shifts());
  std::vector<PeriodicSolution> found = periodic_method("shooting").solve(problem, guess, {});
  verify_stable(problem, found);
  EXPECT_TRUE(found[0].stable());
  EXPECT_LT(found[0].verification.departure, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Ratios, RatioOfBelt, testing::Values(3.7, 2.05, 2.3, 3.1, 3.9, 4.05));

/// Increments rounded to whole turns let the belt be stretched anew in every period: multipliers and closing look well,
/// a run does not.
TEST(VerifiedOrbit, RefutesAMotionThatClosesByWholeTurnsOnly)
{
  RotorTrain      system = belt_drive(3.7);
  PeriodicGuess   guess;
  PeriodicProblem problem = train_problem(system, {0, 1}, Eigen::Vector2d(28., 28. / 3.7), guess);
  problem.turn            = 2. * M_PI * Eigen::Vector2d(11., 3.);
  problem.period          = 3. * 2. * M_PI / (28. / 3.7);
  auto found              = periodic_method("shooting").solve(problem, guess, {});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_LT(found[0].residual, 1e-9);
  EXPECT_TRUE(found[0].stable()); // by its multipliers
  verify_stable(problem, found);
  EXPECT_FALSE(found[0].stable());
  EXPECT_TRUE(found[0].verification.leaves);
  EXPECT_THAT(found[0].notes.back(), testing::HasSubstr("not rated stable"));
}

/// Along a branch three motions are run, and all of them where one goes away.
TEST(VerifiedOrbit, OfABranchIsThatOfThreeSolutionsOfEachStretch)
{
  RotorTrain      system = belt_drive(3.7);
  PeriodicGuess   guess;
  PeriodicProblem problem  = train_problem(system, {0, 1}, Eigen::Vector2d(28., 28. / 3.7), guess);
  const auto      verified = [&]
  {
    const PeriodicSolution motion = periodic_method("shooting").solve(problem, guess, {}).front();
    Branch                 branch;
    for (int i = 0; i < 8; ++i)
      branch.points.push_back({double(i), motion});
    branch.points[5].solution.multipliers[0] = 2.;
    verify_branch([&](double) { return FamilyMember{problem, nullptr}; }, branch);
    std::string tried, left;
    for (const BranchPoint &point : branch.points)
    {
      tried += point.solution.verification.periods == verified_periods ? '+' : '-';
      left += point.solution.verification.leaves ? '+' : '-';
    }
    return tried + ' ' + left;
  };
  EXPECT_EQ(verified(), "+-+-+-++ --------");
  problem.turn   = 2. * M_PI * Eigen::Vector2d(11., 3.);
  problem.period = 3. * 2. * M_PI / (28. / 3.7);
  EXPECT_EQ(verified(), "+++++-++ +++++-++");
}

/// Steps of first order, 64 in a period, brake an oscillator by omega h/2 = 5 % of critical, as much as its damper: the
/// motion to which they settle at its resonance is half of the true one, and half the step goes elsewhere.
TEST(VerifiedOrbit, RefutesAMotionThatIsOfItsSteps)
{
  const MatrixXd one = MatrixXd::Identity(1, 1);
  SmallSystem    system(one, 0.1 * one, one);
  system.loads().add_harmonic(0, 1., 1., 0.);
  PeriodicProblem problem;
  problem.system     = &system;
  problem.period     = 2. * M_PI;
  problem.turn       = VectorXd::Zero(1);
  const auto settled = [&](const MethodOptions &integration)
  {
    PeriodicOptions options;
    options.integration = integration;
    options.tolerance   = 1e-6;
    auto found = periodic_method("settling").solve(problem, {VectorXd::Zero(1), VectorXd::Zero(1), 0.}, options);
    verify_stable(problem, found);
    return found.front();
  };
  MethodOptions coarse = options_of("bdf", 1), fine = options_of("bdf", 5);
  coarse.step    = 2. * M_PI / 64.;
  fine.tolerance = 1e-5;
  EXPECT_TRUE(settled(coarse).verification.leaves);
  const PeriodicSolution true_one = settled(fine);
  EXPECT_TRUE(true_one.stable());
  EXPECT_EQ(true_one.verification.periods, verified_periods);
}

/// A base that a load shakes, and a motor on a round rotor: it slips, at the speed of its balance, while the base has
/// the period of the load.
TEST(ShiftInvariance, ARoundRotorSlipsAgainstThePeriodOfALoad)
{
  const Eigen::Vector2d m(2., 0.1);
  MatrixXd              B = MatrixXd::Zero(2, 2), C = B;
  B.diagonal() << 1., brake;
  C(0, 0) = 50.;
  RotorTrain system(m, B, C, {{Eigen::Vector2d(0., 1.), motor()}});
  system.loads().add_harmonic(0, 9., 3., 0.);
  PeriodicGuess         guess;
  const PeriodicProblem problem = train_problem(system, {1}, Eigen::Vector2d(0., 29.), guess, 2. * M_PI / 9.);
  ASSERT_EQ(problem.free.cols(), 1);
  guess.q[1]         = 0.7;
  const double omega = rise * speed / (rise + brake), x = 3. / std::hypot(50. - 2. * 81., 9.);
  for (const std::string method : {"shooting", "settling", "collocation", "minimise"})
  {
    PeriodicOptions options;
    options.own["starts"] = 4;
    auto found            = periodic_method(method).solve(problem, guess, options);
    ASSERT_EQ(found.size(), 1u) << method;
    EXPECT_NEAR(found[0].v[1], omega, 1e-8 * omega) << method;
    EXPECT_NEAR(std::hypot(found[0].q[0], found[0].v[0] / 9.), x, 1e-8 * x) << method;
    EXPECT_NEAR(found[0].turn[1], omega * problem.period, 1e-7) << method;
    EXPECT_EQ(found[0].multipliers.size(), 3) << method; // without that of the angle
    if (method == "shooting" || method == "settling") // collocation keeps the angle in modes, minimise begins anywhere
    {
      EXPECT_NEAR(found[0].q[1], 0.7, 1e-9) << method;
    }
    verify_stable(problem, found);
    EXPECT_TRUE(found[0].stable()) << method;
  }
  for (const std::string method : {"harmonic-balance", "averaging"})
    EXPECT_NE(periodic_method(method).refuses(problem), "") << method;
}

/// What is said of the angles: the belt never repeats, the crank after a turn, and nothing depends on the round rotor.
TEST(ShiftInvariance, IsFoundFromTheEquations)
{
  MatrixXd C            = MatrixXd::Zero(4, 4);
  C.topLeftCorner(2, 2) = of_belt(80., 3.7);
  const auto of         = [](int i) { return VectorXd(VectorXd::Unit(4, i)); };
  const auto two_turn   = [](double u, double, double &p, double &du, double &dv)
  { p = std::cos(0.5 * u), du = -0.5 * std::sin(0.5 * u), dv = 0.; };
  RotorTrain            system(VectorXd::Ones(4), MatrixXd::Zero(4, 4), C,
                               {{of(0), motor()}, {of(1), weight(2.)}, {of(2), motor()}, {of(3), two_turn}});
  const AngleInvariance invariance(system, {0, 1, 2, 3}, {VectorXd::Zero(4), VectorXd::Ones(4), 0.}, 0.);
  const MatrixXd        free = invariance.free();
  ASSERT_EQ(free.cols(), 1);
  EXPECT_NEAR(std::abs(free(2, 0)), 1., 1e-14);
  ASSERT_EQ(invariance.dependences().size(), 3u);
  EXPECT_EQ(invariance.dependences()[0].turns, 1);
  EXPECT_EQ(invariance.dependences()[0].element, "element 1");
  EXPECT_EQ(invariance.dependences()[1].turns, 2);
  EXPECT_EQ(invariance.dependences()[2].turns, 0);
  EXPECT_EQ(invariance.changed_by(2. * M_PI * Eigen::Vector4d(0., 0., 0.3, 0.)), "");
  EXPECT_EQ(invariance.changed_by(2. * M_PI * Eigen::Vector4d(0., 0., 0., 1.)), "element 3");
}

/// Cranks on both sides of an irrational ratio never come back together, with the true reason.
TEST(ShiftInvariance, CranksWithoutACommonPeriodAreRefused)
{
  RotorTrain            system(Eigen::Vector2d(0.02, 0.5), of_belt(0.3, M_SQRT2), of_belt(80., M_SQRT2),
                               {{Eigen::Vector2d(1., 0.), weight(0.1)}, {Eigen::Vector2d(0., 1.), weight(0.8)}});
  const VectorXd        speeds = Eigen::Vector2d(28., 28. / M_SQRT2);
  const AngleInvariance invariance(system, {0, 1}, {VectorXd::Zero(2), speeds, 0.}, 0.);
  EXPECT_THAT(increments_of(invariance, speeds, 0., 0.01, system).refusal, testing::HasSubstr("no common period"));
}
