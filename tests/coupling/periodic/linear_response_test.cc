// Frequency responses against the whole equations, solved independently with more digits.

#include "coupling/periodic/response/linear_response.h"
#include "coupling/periodic/response/response_peaks.h"
#include "tests/support/linear_machine.h"
#include "tests/support/refusal.h"
#include "tests/support/test.h"

#include <Eigen/Dense>

#include <random>

namespace gestell::tests
{
namespace
{

using namespace coupling;
using Matrix      = Eigen::MatrixXd;
using Vector      = Eigen::VectorXd;
using Complex     = std::complex<double>;
using Long        = std::complex<long double>;
using LongComplex = Eigen::Matrix<Long, Eigen::Dynamic, Eigen::Dynamic>;

/// Z(w) = -w^2 M + i w B + C with the elements, in extended precision.
LongComplex whole(const LinearMachine &machine, double omega)
{
  const auto        w    = (long double)omega;
  const auto        wide = [](const Matrix &A) { return LongComplex(A.cast<Long>()); };
  const LongComplex W    = wide(machine.W);
  return wide(machine.C) + Long(0, w) * wide(machine.B) - w * w * wide(machine.M) +
         W * (wide(machine.K) + Long(0, w) * wide(machine.D) - w * w * wide(machine.N)) * W.transpose();
}

/// q [n x columns] with the joints as rows of a saddle.
LongComplex solved(const LinearMachine &machine, double omega, const Matrix &F)
{
  const Eigen::Index n = machine.M.rows(), n_c = machine.G.rows();
  const LongComplex  GW = (machine.G * machine.W.transpose()).cast<Long>();
  LongComplex        A = LongComplex::Zero(n + n_c, n + n_c), f = LongComplex::Zero(n + n_c, F.cols());
  A.topLeftCorner(n, n)      = whole(machine, omega);
  A.topRightCorner(n, n_c)   = -GW.transpose();
  A.bottomLeftCorner(n_c, n) = GW;
  f.topRows(n)               = F.cast<Long>();
  return A.fullPivLu().solve(f).topRows(n);
}

/// Largest difference beside the largest entry of each column.
double distance(const Eigen::MatrixXcd &q, const LongComplex &exact)
{
  double worst = 0.;
  for (Eigen::Index c = 0; c < q.cols(); ++c)
    worst = std::max(worst, double((q.col(c).cast<Long>() - exact.col(c)).norm() / exact.col(c).norm()));
  return worst;
}

constexpr double frequencies[] = {0.3, 7., 31., 55.5, 104., 380., 4100.};

} // namespace

TEST(LinearResponse, IsTheSolutionOfTheWholeEquations)
{
  for (const unsigned seed : {1u, 2u, 3u})
  {
    const LinearMachine  machine  = random_machine(seed);
    const LinearResponse response = response_of(machine);
    const Matrix         F        = Matrix::Identity(9, 9);
    EXPECT_EQ(response.not_condensed(), "");
    for (const double omega : frequencies)
      EXPECT_LT(distance(response.at(omega, F).q, solved(machine, omega, F)), 1e-12) << omega;
  }
}

TEST(LinearResponse, IsReciprocal)
{
  const LinearMachine  machine  = random_machine(4);
  const LinearResponse response = response_of(machine);
  for (const double omega : frequencies)
  {
    const Eigen::MatrixXcd H = response.at(omega, Matrix::Identity(9, 9)).q;
    EXPECT_LT((H - H.transpose()).norm(), 1e-13 * H.norm()) << omega;
  }
}

TEST(LinearResponse, TellsTheForcesOfTheElements)
{
  const LinearMachine    machine  = random_machine(5);
  const LinearResponse   response = response_of(machine);
  const double           omega    = 42.;
  const Vibration        x        = response.at(omega, Matrix::Identity(9, 2));
  const Matrix           stiff    = machine.K - omega * omega * machine.N;
  const Eigen::MatrixXcd u = machine.W.transpose() * x.q, p = -(stiff + Complex(0., omega) * machine.D) * u;
  EXPECT_LT((x.p - p).norm(), 1e-11 * p.norm());
}

TEST(LinearResponse, KeepsJointsClosed)
{
  std::mt19937  dice(6);
  LinearMachine machine = random_machine(6);
  machine.G             = random_matrix(2, 4, dice);
  machine.finish();
  const LinearResponse response = response_of(machine);
  for (const double omega : frequencies)
  {
    const Vibration x = response.at(omega, Matrix::Identity(9, 9));
    EXPECT_LT(distance(x.q, solved(machine, omega, Matrix::Identity(9, 9))), 1e-12) << omega;
    EXPECT_LT((machine.G * machine.W.transpose() * x.q).norm(), 1e-12 * x.q.norm() * machine.G.norm()) << omega;
    EXPECT_EQ(x.lambda.rows(), 2);
  }
}

TEST(LinearResponse, TakesUnconstrainedMotions)
{
  // Two masses on one spring: together they are free, and dampers do not reach them.
  LinearMachine machine(2, 0);
  machine.M = Vector::Constant(2, 3.).asDiagonal();
  machine.C << 300., -300., -300., 300.;
  machine.finish();
  const LinearResponse response = response_of(machine);
  for (const double omega : {0.01, 1., 9., 1000.})
    EXPECT_LT(distance(response.at(omega, Matrix::Identity(2, 2)).q, solved(machine, omega, Matrix::Identity(2, 2))),
              1e-13)
        << omega;
}

TEST(LinearResponse, TakesLagsThatElementsFeed)
{
  // The last coordinate is a state T x' + x = p of a control that a measure feeds and that acts on another one.
  LinearMachine machine = random_machine(7, 6, 3);
  machine.M.row(5).setZero(), machine.M.col(5).setZero();
  machine.B.row(5).setZero(), machine.B.col(5).setZero();
  machine.C.row(5).setZero(), machine.C.col(5).setZero();
  machine.B(5, 5) = 0.02, machine.C(5, 5) = 1.;
  machine.W.row(5).setZero(), machine.W.col(2).setZero();
  machine.W(5, 2) = 1.;
  machine.K(2, 0) = -40., machine.K(0, 2) = 3.;
  machine.lags = {5};
  machine.finish();
  const LinearResponse response = response_of(machine);
  EXPECT_EQ(response.not_condensed(), "");
  for (const double omega : frequencies)
    EXPECT_LT(distance(response.at(omega, Matrix::Identity(6, 5)).q, solved(machine, omega, Matrix::Identity(6, 5))),
              1e-12)
        << omega;
}

TEST(LinearResponse, SolvesTheWholeEquationsWhereACoordinateHasNoMass)
{
  LinearMachine machine = random_machine(8);
  machine.M.row(3).setZero(), machine.M.col(3).setZero();
  machine.finish();
  const LinearResponse response = response_of(machine);
  EXPECT_THAT(response.not_condensed(), ::testing::HasSubstr("q3"));
  for (const double omega : frequencies)
    EXPECT_LT(distance(response.at(omega, Matrix::Identity(9, 9)).q, solved(machine, omega, Matrix::Identity(9, 9))),
              1e-12)
        << omega;
}

TEST(LinearResponse, OfAnElementThatDetunesAnUndampedModeIsFiniteAtItsFrequency)
{
  // The base is driven at its own frequency of 10 rad/s; with the element it has another one.
  LinearMachine machine(1, 1);
  machine.M << 2.;
  machine.C << 200.;
  machine.W << 1.;
  machine.K << 50.;
  machine.finish();
  EXPECT_NEAR(std::abs(response_of(machine).at(10., Matrix::Identity(1, 1)).q(0, 0) - 1. / 50.), 0., 1e-15);
}

TEST(LinearResponse, RefusesTheFrequencyOfAnUndampedMode)
{
  LinearMachine machine(1, 0);
  machine.M << 2.;
  machine.C << 200.;
  machine.finish();
  expect_refusal<ConvergenceFailure>([&] { response_of(machine).at(10., Matrix::Identity(1, 1)); }, "undamped mode");
  expect_refusal([&] { response_of(machine).at(0., Matrix::Identity(1, 1)); }, "must be above zero");
}

TEST(UnstableModes, OfAMachineWithPositiveMatricesAreNone)
{
  for (const unsigned seed : {1u, 2u, 3u})
    EXPECT_THAT(*response_of(random_machine(seed)).growing(), testing::IsEmpty());
}

// Gyroscopic forces do no work; a free motion rests.
TEST(UnstableModes, AreNoneOfAGyroscopicMachineWithAFreeMotion)
{
  LinearMachine machine(3, 0);
  machine.M.setIdentity();
  machine.B << 0., 30., 0., -30., 0., 0., 0., 0., 0.;
  machine.C.diagonal() << 4e4, 9e4, 0.;
  machine.finish();
  EXPECT_THAT(*response_of(machine).growing(), testing::IsEmpty());
}

// s^2 + 1e4 + i k = 0 in q0 + i q1
TEST(UnstableModes, OfACirculatoryForceHaveTheRateOfTheClosedSolution)
{
  LinearMachine machine(2, 0);
  machine.M.setIdentity();
  machine.C << 1e4, 300., -300., 1e4;
  machine.finish();
  const auto growing = *response_of(machine).growing();
  ASSERT_EQ(growing.size(), 1u);
  const Complex s = std::sqrt(Complex(-1e4, 300.));
  EXPECT_NEAR(growing[0].real(), s.real(), 1e-11 * std::abs(s));
  EXPECT_NEAR(growing[0].imag(), s.imag(), 1e-11 * std::abs(s));
}

// Upside down pendulums, the first beside a body of high frequency, the second held by a joint.
TEST(UnstableModes, AreThoseThatJointsLeaveFree)
{
  LinearMachine machine(3, 3);
  machine.M.setIdentity();
  machine.C.diagonal() << -9., 1e10, -16.;
  machine.W.setIdentity();
  machine.G.resize(1, 3);
  machine.G << 0., 0., 1.;
  machine.finish();
  const auto growing = *response_of(machine).growing();
  ASSERT_EQ(growing.size(), 1u);
  EXPECT_NEAR(growing[0].real(), 3., 1e-9);
  EXPECT_EQ(growing[0].imag(), 0.);
}

// T x' + x = -g q' feeds back: s^2 + 100 - k x = 0 with x = -g s q/(1 + T s).
TEST(UnstableModes, AreFoundBesideCoordinatesWithoutMass)
{
  LinearMachine machine(2, 0);
  const double  T = 0.01, g = 2.;
  machine.M(0, 0) = 1.;
  machine.B << 0., 0., g, T;
  machine.C << 100., 1., 0., 1.;
  machine.finish();
  const auto growing = *response_of(machine).growing();
  ASSERT_EQ(growing.size(), 1u);
  const Complex s = growing[0];
  EXPECT_LT(std::abs((s * s + 100.) * (1. + T * s) - g * s), 1e-8 * std::abs(s * s));
  EXPECT_GT(s.real(), 0.5);
}

TEST(LinearAnswer, AddsUpDerivativesForcesAndMultipliers)
{
  Vibration x;
  x.omega                = 3.;
  x.q                    = Eigen::MatrixXcd::Constant(1, 1, Complex(1., 2.));
  x.p                    = Eigen::MatrixXcd::Constant(1, 1, Complex(0., 5.));
  x.lambda               = Eigen::MatrixXcd::Constant(1, 1, Complex(-1., 0.));
  const auto         one = [](double w) { return Vector::Constant(1, w); };
  const LinearAnswer answer{one(2.), one(7.), one(11.), one(13.), one(17.)};
  const Complex      s(0., 3.), q(1., 2.);
  EXPECT_LT(std::abs(answer.of(x, 0) - (2. * q + 7. * s * q + 11. * s * s * q + 13. * Complex(0., 5.) - 17.)), 1e-13);
}

TEST(ResponsePeaks, OfAnOscillatorAreThoseOfItsClosedSolution)
{
  // |H| = 1/sqrt((w0^2 - w^2)^2 + (2 D w0 w)^2) at w = w0 sqrt(1 - 2 D^2); half power at w^2 = w0^2 (1 - 2 D^2 -+ 2 D
  // sqrt(1 - D^2)).
  const double f_0 = 50.;
  for (const double D : {0.2, 0.01, 1e-4})
  {
    const auto amplitude = [&](double f)
    {
      const double r = f / f_0;
      return 1. / std::hypot(1. - r * r, 2. * D * r);
    };
    std::vector<double> f, a;
    for (double x = 5.; x < 500.; x *= 1.02)
      f.push_back(x);
    for (const double nearby : {-4., -1., 0., 1., 4.})
      f.push_back(f_0 * (1. + nearby * D));
    std::sort(f.begin(), f.end());
    for (const double x : f)
      a.push_back(amplitude(x));
    const auto peaks = response_peaks(amplitude, f, a);
    ASSERT_EQ(peaks.size(), 1u) << D;
    // A top is known by its height, which rounding hides within the root of epsilon.
    EXPECT_NEAR(peaks[0].frequency_hz / (f_0 * std::sqrt(1. - 2. * D * D)), 1., 3e-8) << D;
    EXPECT_NEAR(peaks[0].amplitude * 2. * D * std::sqrt(1. - D * D), 1., 1e-9) << D;
    const double side = 2. * D * std::sqrt(1. - D * D), middle = 1. - 2. * D * D;
    const double width = std::sqrt(middle + side) - std::sqrt(std::max(0., middle - side));
    EXPECT_NEAR(peaks[0].damping_ratio / (width / (2. * std::sqrt(middle))), 1., 1e-5) << D;
  }
}

TEST(ResponsePeaks, WithoutHalfPowerPointsTellNoDamping)
{
  const auto          amplitude = [](double f) { return 1. + 0.1 * std::sin(f); };
  std::vector<double> f, a;
  for (double x = 0.1; x < 6.; x += 0.1)
  {
    f.push_back(x);
    a.push_back(amplitude(x));
  }
  const auto peaks = response_peaks(amplitude, f, a);
  ASSERT_EQ(peaks.size(), 1u);
  EXPECT_NEAR(peaks[0].frequency_hz, M_PI / 2., 1e-7);
  EXPECT_TRUE(std::isnan(peaks[0].damping_ratio));
}

} // namespace gestell::tests
