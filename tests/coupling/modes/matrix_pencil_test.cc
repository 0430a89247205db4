// The matrix pencil against sums of damped oscillations.

#include "coupling/modes/matrix_pencil.h"

#include "fem/values/two_pi.h"
#include "tests/support/refusal.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

/// f [Hz], zeta, amplitude, phase.
struct Decay
{
  double f, zeta, amplitude, phase;

  double at(double t) const
  {
    const double omega = two_pi * f, delta = zeta * omega / std::sqrt(1. - zeta * zeta);
    return amplitude * std::exp(-delta * t) * std::cos(omega * t + phase);
  }
};

const std::vector<Decay> decays{{0.404, 0.0041, 0.17, 0.3}, {1.245, 0.035, 0.01, -1.}, {2.6, 0.078, 0.004, 2.}};

Eigen::MatrixXd samples_of(int n, double h)
{
  Eigen::MatrixXd samples(n, 2);
  for (int i = 0; i < n; ++i)
    for (int s = 0; s < 2; ++s)
    {
      samples(i, s) = s == 0 ? -3. : 40.; // where it comes to rest
      for (std::size_t j = 0; j < decays.size(); ++j)
        samples(i, s) += (s == 0 ? 1. : 100. * double(j)) * decays[j].at(h * i);
    }
  return samples;
}

// A sum of exponentials has a Hankel matrix of that rank: what is found is exact up to rounding.
TEST(MatrixPencil, FindsDampedOscillationsExactly)
{
  const auto fit = coupling::matrix_pencil(samples_of(300, 0.02), 0.02, 3);
  ASSERT_EQ(fit.oscillations.size(), 3u);
  EXPECT_LT(fit.residual, 1e-9);
  for (std::size_t j = 0; j < 3; ++j)
  {
    EXPECT_NEAR(fit.oscillations[j].frequency_hz(), decays[j].f, 1e-8);
    EXPECT_NEAR(fit.oscillations[j].damping_ratio(), decays[j].zeta, 1e-8);
    EXPECT_NEAR(std::abs(fit.oscillations[j].amplitudes[0]), decays[j].amplitude, 1e-8);
    EXPECT_NEAR(std::abs(fit.oscillations[j].amplitudes[1]), 100. * double(j) * decays[j].amplitude, 1e-6);
  }
}

TEST(MatrixPencil, TellsTheStrongestOfThem)
{
  const auto fit = coupling::matrix_pencil(samples_of(300, 0.02).leftCols(1), 0.02, 1);
  ASSERT_EQ(fit.oscillations.size(), 1u);
  EXPECT_NEAR(fit.oscillations[0].frequency_hz(), 0.404, 1e-8);
}

TEST(MatrixPencil, OfWhatStandsStillHasNothing)
{
  EXPECT_TRUE(coupling::matrix_pencil(Eigen::MatrixXd::Ones(100, 2), 0.01, 3).oscillations.empty());
  expect_refusal([] { coupling::matrix_pencil(Eigen::MatrixXd::Ones(10, 2), 0.01, 3); }, "10 samples");
}

} // namespace
} // namespace gestell::tests
