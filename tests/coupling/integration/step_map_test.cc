// Stability and overshoot of the integrators as they are: every number comes from steps they take themselves.

#include "coupling/integration/bdf/bdf_method.h"
#include "tests/support/step_map.h"

#include "tests/support/reference_table.h"
#include "tests/support/small_system.h"
#include "tests/support/test.h"

#include <Eigen/LU>

namespace gestell::tests
{
namespace
{

using namespace coupling;
using Complex = std::complex<double>;

// A step q -> A q and the method's amplification matrix have det(1 - z A) = prod (1 - z r) over the same roots r, so
// that all that stability_test.cc proves of those roots is true of the integrator.  Roots that are zero count in
// neither.
TEST(StepMap, HasTheRootsOfTheAmplificationMatrix)
{
  int rows = 0;
  for (const auto &row : read_reference("stability/spectral_radius.csv"))
  {
    const auto options = named_method(row["method"]);
    if (!options)
      continue;
    const double          zeta = row.number("zeta"), omega_h = row.number("omega_h");
    const Eigen::MatrixXd taken    = step_map(row["method"], zeta, omega_h),
                          reported = method_of(*options).amplification_matrix(*options, {zeta, omega_h});
    const auto determinant         = [](const Eigen::MatrixXd &A, Complex z)
    { return (Eigen::MatrixXcd::Identity(A.rows(), A.rows()) - z * A).determinant(); };
    const double scale = 1. / std::max(1., row.number("spectral_radius"));
    for (const Complex direction : {Complex(1., 0.), Complex(-1., 0.), Complex(0., 1.), Complex(0.6, 0.8)})
    {
      const Complex z = 0.7 * scale * direction, expected = determinant(reported, z);
      EXPECT_LT(std::abs(determinant(taken, z) - expected), 1e-9 * std::abs(expected))
          << row["method"] << " zeta " << zeta << " omega h " << omega_h << " z " << z;
    }
    ++rows;
  }
  EXPECT_EQ(rows, 2600);
}

TEST(BdfFormula, CoefficientsAreThoseOfTheReference)
{
  int found = 0;
  for (const auto &row : read_reference("stability/limits.csv"))
    if (row["quantity"].find("and alpha_i") != std::string::npos)
    {
      const BdfFormula  &formula = bdf_formulas[bdf_order(row["quantity"]) - 1];
      std::istringstream values(row["value"]);
      double             value;
      char               semicolon;
      values >> value >> semicolon;
      EXPECT_NEAR(value, formula.beta0, 1e-15);
      values >> value;
      EXPECT_EQ(value, 1.);
      for (int i = 0; values >> value; ++i)
        EXPECT_NEAR(value, formula.alpha[i], 1e-15 * std::abs(value));
      ++found;
    }
  EXPECT_EQ(found, 6);
}

/// |x| and |v|/omega after steps 0..20.
struct Overshoot
{
  std::vector<double> x, v;
};

Overshoot run(const std::string &method, double omega, double x0, double v0)
{
  const SmallSystem system(Eigen::MatrixXd::Identity(1, 1), Eigen::MatrixXd::Zero(1, 1),
                           Eigen::MatrixXd::Constant(1, 1, omega * omega));
  Overshoot         way;
  const auto        note = [&](const Instant &now)
  {
    way.x.push_back(std::abs(now.q[0]));
    way.v.push_back(std::abs(now.v[0]) / omega);
  };
  std::vector<Eigen::VectorXd> q{Eigen::VectorXd::Constant(1, x0)}, v{Eigen::VectorXd::Constant(1, v0)};
  if (const int order = bdf_order(method))
  {
    way.x.push_back(std::abs(x0));
    way.v.push_back(std::abs(v0) / omega);
    for (int n = 1; n <= 20; ++n) // the first steps by orders 1, 2, ...
    {
      Bdf bdf(system, {std::min(n, order), 1.});
      bdf.begin(0., q, v);
      bdf.advance();
      note(bdf.instant());
      q.insert(q.begin(), bdf.instant().q);
      v.insert(v.begin(), bdf.instant().v);
      q.resize(std::min<std::size_t>(q.size(), 6));
      v.resize(q.size());
    }
    return way;
  }
  const auto integrator = one_step_method(method, system, 1.);
  integrator->begin(0., q[0], v[0]);
  note(integrator->instant());
  for (int n = 0; n < 20; ++n)
  {
    integrator->advance();
    note(integrator->instant());
  }
  return way;
}

TEST(StepMap, OvershootInTheFirstStepsIsThatOfTheReference)
{
  int rows = 0;
  for (const auto &row : read_reference("stability/overshoot.csv"))
  {
    const double omega_h   = row.number("omega_h");
    const bool   displaced = row["start"] == "x0=1,v0=0";
    const auto   way       = run(row["method"], omega_h, displaced ? 1. : 0., displaced ? 0. : omega_h);
    const auto   expect    = [&](const std::vector<double> &sizes, const char *largest, const char *step)
    {
      // Given with 11 digits; 20 steps of large omega h lose as many as the map's entries are large.
      const double expected = row.number(largest);
      EXPECT_NEAR(*std::max_element(sizes.begin(), sizes.end()), expected, 1e-9 * expected)
          << row["method"] << " " << omega_h << " " << row["start"] << " " << largest;
      EXPECT_NEAR(sizes.at(std::stoi(row[step])), expected, 1e-9 * expected) << row["method"] << " " << omega_h;
    };
    expect(way.x, "max_abs_x_first_20_steps_rel", "step_of_max_x");
    expect(way.v, "max_abs_v_over_w_first_20_steps_rel", "step_of_max_v");
    ++rows;
  }
  EXPECT_EQ(rows, 168);
}

} // namespace
} // namespace gestell::tests
