// What does not repeat after a period: the exponent against what is known of it, the kind of every sort of motion.

#include "coupling/periodic/recurrence.h"
#include "coupling/periodic/shooting/shooting_method.h"
#include "tests/support/periodic_cases.h"
#include "tests/support/refusal.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace coupling;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// x'' + b x' + c x + beta x^3 = F cos(Omega t)
CubicSystem cubic_oscillator(double b, double c, double beta, double F, double Omega)
{
  const MatrixXd one = MatrixXd::Identity(1, 1);
  CubicSystem    system(one, b * one, c * one, {{beta, VectorXd::Ones(1)}});
  system.loads().add_harmonic(0, Omega, F, 0.);
  return system;
}

Recurrence followed(SecondOrderSystem &system, double Omega, double q, double v, int periods, int ratio = 1)
{
  PeriodicProblem problem = problem_of_period(system, ratio * 2. * M_PI / Omega);
  problem.ratio           = ratio;
  const int n             = system.linear().size();
  return recurrence_of(problem, {VectorXd::Constant(n, q), VectorXd::Constant(n, v), 0.}, {}, periods);
}

} // namespace

/// The section of a linear oscillator contracts with its damping, from any start.
TEST(Recurrence, OfALinearOscillatorIsItsPeriodAndItsDamping)
{
  CubicSystem      linear = cubic_oscillator(0.1, 1., 0., 1., 1.4);
  const Recurrence motion = followed(linear, 1.4, 1., 0., 64);
  EXPECT_EQ(motion.kind, "periodic");
  EXPECT_EQ(motion.repeats, 1);
  EXPECT_NEAR(motion.exponent, -0.05, 4. * motion.error);
  EXPECT_LT(motion.error, 0.01);
}

/// Damped so little that after 256 periods an eighth of the transient is left: not to be taken for a second frequency.
TEST(Recurrence, OfATransientThatDiesSlowlyIsSettling)
{
  const double     b      = 2. * std::log(8.) / (256. * 2. * M_PI / 1.4);
  CubicSystem      linear = cubic_oscillator(b, 1., 0., 1., 1.4);
  const Recurrence motion = followed(linear, 1.4, 1., 0., 128);
  EXPECT_EQ(motion.kind, "settling");
  EXPECT_EQ(motion.repeats, 1);
  EXPECT_FALSE(motion.is_recognised());
  CubicSystem slower = cubic_oscillator(0.1 * b, 1., 0., 1., 1.4);
  EXPECT_EQ(followed(slower, 1.4, 1., 0., 128).kind, "settling");
}

/// x'' + 0.05 x' + x^3 = 7.5 cos t (Ueda 1979).  20000 periods by Runge and Kutta's method in a program of its own give
/// 0.1035 with 0.001 of doubt, publications 0.10 to 0.11.
TEST(Recurrence, OfUedasOscillatorIsChaos)
{
  CubicSystem      ueda   = cubic_oscillator(0.05, 0., 1., 7.5, 1.);
  const Recurrence motion = followed(ueda, 1., 2., 1., 400);
  EXPECT_EQ(motion.kind, "chaotic");
  EXPECT_EQ(motion.repeats, 0);
  EXPECT_NEAR(motion.exponent, 0.1035, 4. * motion.error);
  EXPECT_LT(motion.error, 0.02);
}

/// Without a spring and pushed, x = F t^2/2: neighbours part as t, and the mean of logarithms falls only as ln K / K.
TEST(Recurrence, OfAFreeMotionIsNotChaos)
{
  const MatrixXd one = MatrixXd::Identity(1, 1), zero = MatrixXd::Zero(1, 1);
  for (const int periods : {64, 256, 1000})
  {
    CubicSystem falls(one, zero, zero, {});
    falls.loads().add_constant(0, -9.81);
    const Recurrence falling = followed(falls, 2. * M_PI / 0.2, 0., 0., periods);
    EXPECT_EQ(falling.kind, "drifting") << periods;
    EXPECT_LT(falling.exponent, 4. * falling.error) << periods;
    CubicSystem      rests(one, zero, zero, {});
    const Recurrence resting = followed(rests, 2. * M_PI / 0.2, 0., 0., periods);
    EXPECT_EQ(resting.kind, "periodic") << periods;
    EXPECT_LT(resting.exponent, 4. * resting.error) << periods;
  }
}

/// Between its Neimark-Sacker points, 1.1127 and 1.1957, two masses beat; beside them they repeat.
TEST(Recurrence, OfTwoMassesBetweenNeimarkSackerPointsIsQuasiPeriodic)
{
  const auto kind = [](double Omega, Recurrence &motion)
  {
    CubicSystem two = two_dof_system("two_dof1", Omega);
    motion          = followed(two, Omega, 0.2, 0.1, 256);
    return motion.kind;
  };
  Recurrence motion;
  for (const double Omega : {1.13, 1.15, 1.18})
  {
    EXPECT_EQ(kind(Omega, motion), "quasi-periodic") << Omega;
    // sums of the logarithms stay bounded on a torus: their mean is smaller than what batches wander
    EXPECT_LT(std::abs(motion.exponent), motion.error) << Omega;
    EXPECT_LT(motion.error, 0.005) << Omega;
  }
  EXPECT_EQ(kind(1.05, motion), "periodic");
  EXPECT_EQ(kind(1.25, motion), "periodic");
}

/// Of three motions that a hard spring has at 3.3, and of one at 3.6 whose transient rotates by about a quarter a
/// period, which is no motion of four periods.
TEST(Recurrence, TellsSubharmonicMotionsFromTransientsThatRotate)
{
  CubicSystem      third  = cubic_oscillator(0.05, 1., 0.5, 3., 3.3);
  const Recurrence motion = followed(third, 3.3, 0., 4., 200);
  EXPECT_EQ(motion.kind, "sub-harmonic");
  EXPECT_EQ(motion.repeats, 3);
  EXPECT_LT(motion.exponent, 0.);
  CubicSystem half = cubic_oscillator(0.05, 1., 0.5, 8., 3.3);
  EXPECT_EQ(followed(half, 3.3, 0., 4., 200).repeats, 2);
  CubicSystem rotates = cubic_oscillator(0.05, 1., 0.5, 1., 3.6);
  EXPECT_EQ(followed(rotates, 3.6, 0., 4., 200).repeats, 1);
}

/// A section is that of the load, whatever ratio was searched for.
TEST(Recurrence, CountsPeriodsOfTheLoad)
{
  CubicSystem third = cubic_oscillator(0.05, 1., 0.5, 3., 3.3);
  EXPECT_EQ(followed(third, 3.3, 0., 4., 200, 2).repeats, 3);
}

/// x'' - (1 - x^2) x' + x = 0: the shift in time is left out, neighbours meet with the other multiplier of its cycle.
TEST(Recurrence, OfAFreeCycleLeavesTheShiftInTimeOut)
{
  SmallSystem     system  = van_der_pol(1.);
  PeriodicProblem problem = problem_of_period(system, 6.66);
  problem.phase           = 0;
  const PeriodicGuess start{VectorXd::Zero(1), VectorXd::Ones(1), 6.66};
  const Recurrence    motion = recurrence_of(problem, start, {}, 64);
  const auto          cycle  = shooting_method().solve(problem, start, {});
  EXPECT_EQ(motion.kind, "periodic");
  EXPECT_NEAR(motion.exponent, std::log(cycle[0].largest_multiplier()) / cycle[0].period, 1e-6);
}

TEST(Recurrence, RefusesWhatItCannotFollow)
{
  CubicSystem     linear  = cubic_oscillator(0.1, 1., 0., 1., 1.4);
  PeriodicProblem problem = problem_of_period(linear, 2. * M_PI / 1.4);
  PeriodicOptions options;
  const auto      follow = [&](int periods) {
    recurrence_of(problem, {VectorXd::Zero(1), VectorXd::Zero(1), 0.}, options, periods);
  };
  expect_refusal([&] { follow(20); }, "at least 64");
  options.integration           = options_of("bdf");
  options.integration.tolerance = 1e-6;
  expect_refusal([&] { follow(64); }, "has no tangents");
  std::atomic<bool> stop = true;
  options                = {};
  problem.stop           = &stop;
  EXPECT_THROW(follow(64), SearchInterrupted);
}

} // namespace gestell::tests
