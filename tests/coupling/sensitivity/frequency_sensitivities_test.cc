// Derivatives of natural frequencies by eigenvectors.

#include "coupling/sensitivity/frequency_sensitivities.h"
#include "tests/support/linear_joint.h"
#include "tests/support/test.h"

namespace
{

using namespace gestell::coupling;
using Eigen::VectorXd;

/// ground - c_1 - m_1 - c_2 - m_2, x = (m_1, m_2, c_1, c_2)
Machine two_masses(const VectorXd &x)
{
  MachineModel model;
  model.add_slider("a", {1., 0., 0.}, x[0], "ground");
  model.add_slider("b", {1., 0., 0.}, x[1], "ground");
  const int a = model.coordinate("a"), b = model.coordinate("b");
  model.add_linear("first", {{a, 1.}}, {x[2], 0., 0., 0.}, "N");
  model.add_linear("second", {{b, 1.}, {a, -1.}}, {x[3], 0., 0., 0.}, "N");
  return Machine(std::move(model));
}

/// omega^4 m_1 m_2 - omega^2 (m_1 c_2 + m_2 (c_1 + c_2)) + c_1 c_2 = 0
double frequency(const VectorXd &x, double sign)
{
  const double a = x[0] * x[1], b = x[0] * x[3] + x[1] * (x[2] + x[3]), c = x[2] * x[3];
  return std::sqrt((b + sign * std::sqrt(b * b - 4. * a * c)) / (2. * a)) / (2. * M_PI);
}

TEST(FrequencySensitivities, OfTwoMassesAreThoseOfTheClosedFormula)
{
  const VectorXd                 x = (VectorXd(4) << 3., 1.5, 4000., 900.).finished();
  const std::vector<std::string> open;
  const VectorXd                 rest    = VectorXd::Zero(2);
  const Machine                  machine = two_masses(x);
  const auto                     modes   = linearised_modes(machine, rest, {}, 2);
  std::vector<Machine>           sides;
  sides.reserve(8);
  std::vector<FrequencyTwins> twins;
  for (int k = 0; k < 4; ++k)
  {
    const double step  = 1e-6 * x[k];
    VectorXd     below = x, above = x;
    below[k] -= step;
    above[k] += step;
    sides.push_back(two_masses(below));
    sides.push_back(two_masses(above));
    twins.push_back({{&sides[2 * k], rest, &open}, {&sides[2 * k + 1], rest, &open}, step});
  }
  const Eigen::MatrixXd found = frequency_sensitivities(modes, twins);
  for (int k = 0; k < 4; ++k)
    for (const int mode : {0, 1})
    {
      const double way   = 1e-4 * x[k]; // the quotient of the closed formula errs by 1e-8
      VectorXd     below = x, above = x;
      below[k] -= way;
      above[k] += way;
      const double sign  = mode == 0 ? -1. : 1.;
      const double slope = (frequency(above, sign) - frequency(below, sign)) / (2. * way);
      EXPECT_NEAR(found(mode, k), slope, 1e-6 * frequency(x, sign) / x[k]) << mode << ' ' << k;
    }
}

// omega^2 = c_1/(m_1 + m_2) (1 + O(c_1/c_2)): beside c_2 the soft spring is lost in the rounding of the stiffness
// matrix, whose entry c_1 + c_2 keeps c_1 to 1e-6 and the quotient's 2e-6 c_1 not at all.
TEST(FrequencySensitivities, OfAFrequencyNearZeroBesideStiffSpringsKeepTheirDigits)
{
  const VectorXd                 x = (VectorXd(4) << 3., 1.5, 0.7, 0.7e10).finished();
  const std::vector<std::string> open;
  const VectorXd                 rest    = VectorXd::Zero(2);
  const Machine                  machine = two_masses(x);
  const auto                     modes   = linearised_modes(machine, rest, {}, 2);
  const double                   f       = std::sqrt(x[2] / (x[0] + x[1])) / (2. * M_PI);
  ASSERT_NEAR(modes[0].frequency_hz, f, 1e-5 * f);
  const VectorXd shares = (VectorXd(4) << -0.5 * x[0] / (x[0] + x[1]), -0.5 * x[1] / (x[0] + x[1]), 0.5, 0.).finished();
  for (int k = 0; k < 4; ++k)
  {
    const double step  = 1e-6 * x[k];
    VectorXd     below = x, above = x;
    below[k] -= step;
    above[k] += step;
    const Machine         minus = two_masses(below), plus = two_masses(above);
    const Eigen::MatrixXd found = frequency_sensitivities(modes, {{{&minus, rest, &open}, {&plus, rest, &open}, step}});
    EXPECT_NEAR(found(0, 0) * x[k], shares[k] * f, 1e-5 * f) << k; // of the eigenvalue, rounding of c_2 over c_1
  }
}

/// ground - c - m_1, which a gear of the ratio n joins to m_2: x_2 = n x_1; x = (m_1, m_2, c, n)
Machine geared(const VectorXd &x)
{
  MachineModel model;
  const int    a = model.add_slider("a", {1., 0., 0.}, x[0], "ground");
  const int    b = model.add_slider("b", {1., 0., 0.}, x[1], "ground");
  model.add_linear("spring", {{a, 1.}}, {x[2], 0., 0., 0.}, "N");
  model.attach("gear", std::make_shared<gestell::tests::LinearJoint>(std::vector<double>{x[3], -1.}),
               {{{a, 1.}}, {{b, 1.}}});
  return Machine(std::move(model));
}

// omega^2 = c / (m_1 + n^2 m_2); the ratio of the gear turns its joint and nothing else.
TEST(FrequencySensitivities, SeeWhatAParameterDoesToAJoint)
{
  const VectorXd                 x = (VectorXd(4) << 3., 1.5, 4000., 0.7).finished();
  const std::vector<std::string> open;
  const VectorXd                 rest    = VectorXd::Zero(2);
  const Machine                  machine = geared(x);
  const auto                     modes   = linearised_modes(machine, rest, {}, 1);
  const double                   mass = x[0] + x[3] * x[3] * x[1], f = std::sqrt(x[2] / mass) / (2. * M_PI);
  ASSERT_EQ(modes.size(), 1u);
  ASSERT_NEAR(modes[0].frequency_hz, f, 1e-12 * f);
  const VectorXd slope =
      f * (VectorXd(4) << -0.5 / mass, -0.5 * x[3] * x[3] / mass, 0.5 / x[2], -x[3] * x[1] / mass).finished();
  for (int k = 0; k < 4; ++k)
  {
    const double step  = 1e-6 * x[k];
    VectorXd     below = x, above = x;
    below[k] -= step;
    above[k] += step;
    const Machine         minus = geared(below), plus = geared(above);
    const Eigen::MatrixXd found = frequency_sensitivities(modes, {{{&minus, rest, &open}, {&plus, rest, &open}, step}});
    EXPECT_NEAR(found(0, 0), slope[k], 1e-8 * std::abs(slope[k])) << k; // rounding of a quotient
  }
}

} // namespace
