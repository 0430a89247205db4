#include "coupling/integration/bdf_controlled.h"
#include "coupling/integration/bdf_stability.h"
#include "tests/integration/small_system.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gestell::tests
{
namespace
{

using namespace coupling;
using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

/// With the modes of its base system.
class ModalSystem : public SmallSystem
{
public:
  using SmallSystem::SmallSystem;

  std::vector<SpectrumLine> spectrum() const override
  {
    const auto                n = M.rows();
    std::vector<SpectrumLine> lines;
    Matrix                    A = Matrix::Zero(2 * n, 2 * n);
    A.topRightCorner(n, n).setIdentity();
    A.bottomLeftCorner(n, n)      = -M.inverse() * C;
    A.bottomRightCorner(n, n)     = -M.inverse() * B;
    const Eigen::VectorXcd values = Eigen::EigenSolver<Matrix>(A, false).eigenvalues();
    for (const std::complex<double> &s : values)
      if (s.imag() >= 0.)
        lines.push_back({std::abs(s), std::abs(s) > 0. ? -s.real() / std::abs(s) : 0.});
    return lines;
  }
};

Eigen::Vector2d exact_q(double t)
{
  return {std::sin(2. * t), std::exp(-t)};
}
Eigen::Vector2d exact_v(double t)
{
  return {2. * std::cos(2. * t), -std::exp(-t)};
}

/// Two coupled masses, strongly damped so that every order is stable, driven along q = (sin 2t, e^-t).
ModalSystem driven_chain()
{
  Matrix M(2, 2), B(2, 2), C(2, 2);
  M << 2., 0.3, 0.3, 1.;
  B << 60., -10., -10., 40.;
  C << 300., -100., -100., 250.;
  ModalSystem system(M, B, C);
  system.set_load(
      [=](double t) -> Vector
      {
        const Eigen::Vector2d a(-4. * std::sin(2. * t), std::exp(-t));
        return M * a + B * exact_v(t) + C * exact_q(t);
      });
  return system;
}

struct Outcome
{
  double          q = 0., v = 0.; ///< largest errors for 1 <= t <= 2
  double          mean_step = 0.; ///< there
  IntegrationWork work;
};

Outcome end_errors(const BdfControlled::Options &options)
{
  const ModalSystem system = driven_chain();
  BdfControlled     bdf(system, options);
  bdf.begin(0., exact_q(0.), exact_v(0.));
  Outcome outcome;
  double  first = 0.;
  int     steps = 0;
  while (bdf.time() < 2.)
  {
    bdf.advance();
    const double t = bdf.time();
    if (t < 1.) // past what the start leaves behind
      continue;
    if (first == 0.)
      first = t;
    else
      ++steps;
    outcome.q = std::max(outcome.q, (bdf.instant().q - exact_q(t)).norm());
    outcome.v = std::max(outcome.v, (bdf.instant().v - exact_v(t)).norm());
  }
  outcome.mean_step = (bdf.time() - first) / steps;
  outcome.work      = bdf.work();
  return outcome;
}

class ControlledOrder : public ::testing::TestWithParam<int>
{
};

// Steps are powers of two; between these tolerances the mean step falls about eight times.
TEST_P(ControlledOrder, ErrorFallsWithThePowerOfTheMeanStep)
{
  BdfControlled::Options options;
  options.max_order    = GetParam();
  options.fixed_order  = true;
  options.largest_step = 0.5;
  options.tolerance    = GetParam() == 1 ? 1e-2 : GetParam() == 2 ? 1e-4 : 1e-5;
  const Outcome coarse = end_errors(options);
  options.tolerance *= std::pow(8., -GetParam());
  const Outcome fine  = end_errors(options);
  const double  ratio = std::log(coarse.mean_step / fine.mean_step);
  EXPECT_GT(ratio, std::log(3.5));
  EXPECT_NEAR(std::log(coarse.q / fine.q) / ratio, GetParam(), 0.15);
  EXPECT_NEAR(std::log(coarse.v / fine.v) / ratio, GetParam(), 0.15);
}
INSTANTIATE_TEST_SUITE_P(Orders, ControlledOrder, ::testing::Values(1, 2, 3, 4, 5));

TEST(BdfControlled, ErrorStaysProportionalToTheTolerance)
{
  BdfControlled::Options options;
  options.largest_step = 0.5;
  double smallest = 1e300, largest = 0.;
  for (double tolerance = 1e-3; tolerance > 0.5e-9; tolerance *= 0.1)
  {
    options.tolerance     = tolerance;
    const Outcome outcome = end_errors(options);
    smallest              = std::min(smallest, outcome.q / tolerance);
    largest               = std::max(largest, outcome.q / tolerance);
  }
  EXPECT_LT(largest, 10. * smallest);
  EXPECT_LT(largest, 1.);
}

} // namespace
} // namespace gestell::tests
