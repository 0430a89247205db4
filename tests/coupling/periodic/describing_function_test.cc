#include "coupling/periodic/averaging/describing_function.h"
#include "tests/support/reference_table.h"
#include "tests/support/small_system.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace coupling;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// as in parameters.toml of the reference
constexpr double gap = 0.5, k = 3., k1 = 2., k2 = 50., Fc = 0.7, eps = 0.05, beta = 1.3;

double sign(double x)
{
  return x > 0. ? 1. : x < 0. ? -1. : 0.;
}

double beyond(double x)
{
  return std::abs(x) > gap ? x - gap * sign(x) : 0.;
}

/// A row of the table: its closed formula, and the force f(x, v) itself where it has no memory.
struct Law
{
  std::string                                       begins; ///< of the name in the table
  std::function<DescribingFunction(double, double)> closed; ///< of A and omega
  std::function<double(double, double)>             force;
};

const std::vector<Law> laws = {
    {"clearance", [](double A, double) { return describing::play(k, gap, A); },
     [](double x, double) { return k * beyond(x); }},
    {"bilinear", [](double A, double) { return describing::stops(k1, k2, gap, A); },
     [](double x, double) { return k1 * x + k2 * beyond(x); }},
    {"one-sided", [](double A, double) { return describing::one_sided_stop(k, gap, A); },
     [](double x, double) { return x > gap ? k * (x - gap) : 0.; }},
    {"preload", [](double A, double) { return describing::preload(Fc, k, A); },
     [](double x, double) { return Fc * sign(x) + k * x; }},
    {"cubic", [](double A, double) { return describing::cubic(beta, A); },
     [](double x, double) { return beta * x * x * x; }},
    {"quintic", [](double A, double) { return describing::quintic(beta, A); },
     [](double x, double) { return beta * std::pow(x, 5); }},
    {"Coulomb Fc", [](double A, double w) { return describing::coulomb(Fc, A, w); },
     [](double, double v) { return Fc * sign(v); }},
    {"Coulomb regularised Fc (2/pi)", [](double A, double w) { return describing::coulomb_atan(Fc, eps, A, w); },
     [](double, double v) { return Fc * 2. / M_PI * std::atan(v / eps); }},
    {"Coulomb regularised Fc v", [](double A, double w) { return describing::coulomb_root(Fc, eps, A, w); },
     [](double, double v) { return Fc * v / std::hypot(v, eps); }},
    {"quadratic", [](double A, double w) { return describing::quadratic_damping(beta, A, w); },
     [](double, double v) { return beta * v * std::abs(v); }},
    {"Jenkins", [](double A, double w) { return describing::jenkins(k, Fc, A, w); }, nullptr}};

const Law &law_of_row(const ReferenceRow &row)
{
  for (const Law &law : laws)
    if (row["element"].rfind(law.begins, 0) == 0)
      return law;
  throw std::invalid_argument("no law for " + row["element"]);
}

/// As far as the table has digits: 15 of each number.
void expect_row(const ReferenceRow &row, const DescribingFunction &found, double omega, double share)
{
  const double A = row.number("A");
  const double size =
      std::abs(row.number("mean_force_a0")) / A + std::abs(row.number("k_eq")) + row.number("omega*c_eq");
  EXPECT_NEAR(found.mean / A, row.number("mean_force_a0") / A, share * size) << row["element"] << A;
  EXPECT_NEAR(found.stiffness, row.number("k_eq"), share * size) << row["element"] << A;
  EXPECT_NEAR(omega * found.damping, row.number("omega*c_eq"), share * size) << row["element"] << A;
}

double omega_of(const ReferenceRow &row)
{
  return row["omega"] == "any" ? 1.7 : row.number("omega");
}

} // namespace

TEST(DescribingFunctions, AreTheClosedFormulas)
{
  const auto rows = read_reference("periodic/describing_functions.csv");
  for (const ReferenceRow &row : rows)
    expect_row(row, law_of_row(row).closed(row.number("A"), omega_of(row)), omega_of(row), 1e-13);
  EXPECT_EQ(rows.size(), 75u);
}

/// Kinks and jumps too, by halving about them: the quadrature of a law without memory is its closed formula.
TEST(DescribingFunctions, OfAnyLawFollowFromItsForces)
{
  for (const ReferenceRow &row : read_reference("periodic/describing_functions.csv"))
  {
    const Law &law = law_of_row(row);
    if (!law.force)
      continue;
    const MatrixXd one = MatrixXd::Identity(1, 1);
    SmallSystem    system(one, 0. * one, one);
    system.set_law(VectorXd::Ones(1), [&law](double u, double v, double &p, double &dp_du, double &dp_dv)
                   { p = -law.force(u, v), dp_du = dp_dv = 0.; });
    DescribedForces described(system, VectorXd::Ones(1));
    expect_row(row, described.at(VectorXd::Zero(1), row.number("A"), omega_of(row)), omega_of(row), 1e-12);
  }
}

/// Limits: a slider that never gives way is its spring; a loose friction at small speeds is a damper F/eps; stops that
/// press always are a spring with a preload.
TEST(DescribingFunctions, HaveTheirLimits)
{
  EXPECT_DOUBLE_EQ(describing::jenkins(k, Fc, 0.9 * Fc / k, 2.).stiffness, k);
  EXPECT_DOUBLE_EQ(describing::jenkins(k, Fc, 0.9 * Fc / k, 2.).damping, 0.);
  EXPECT_NEAR(describing::coulomb_root(Fc, eps, 1e-7, 1.).damping, Fc / eps, 1e-11 * Fc / eps);
  EXPECT_NEAR(describing::coulomb_atan(Fc, eps, 1e-7, 1.).damping, 2. / M_PI * Fc / eps, 1e-11 * Fc / eps);
  EXPECT_DOUBLE_EQ(describing::one_sided_stop(k, -2., 1.).mean, 2. * k);
  EXPECT_DOUBLE_EQ(describing::one_sided_stop(k, -2., 1.).stiffness, k);
  EXPECT_EQ(describing::play(k, gap, gap).stiffness, 0.);
}

/// Small motions about a large mean: the force is rounding in its last digits, which no halving mends.  The quadrature
/// ends, as right as u is.
TEST(DescribingFunctions, EndAtTheRoundingOfTheMotion)
{
  const MatrixXd one = MatrixXd::Identity(1, 1);
  SmallSystem    system(one, 0. * one, one);
  long           evaluations = 0;
  system.set_law(VectorXd::Ones(1),
                 [&](double u, double, double &p, double &dp_du, double &dp_dv)
                 {
                   ++evaluations;
                   p     = -k * (u - 1.);
                   dp_du = dp_dv = 0.;
                 });
  DescribedForces described(system, VectorXd::Ones(1));
  for (const double A : {1e-6, 1e-8, 1e-10})
  {
    const double rounding = std::numeric_limits<double>::epsilon() / A;
    EXPECT_NEAR(described.at(VectorXd::Ones(1), A, 1.).stiffness, k, k * rounding) << A;
  }
  EXPECT_LT(evaluations, 1000000);
}

/// About another mean, and along a direction of two measures: f = d^T p, its stiffness with both squares of d.
TEST(DescribingFunctions, FollowAMeanAndADirection)
{
  const MatrixXd one = MatrixXd::Identity(1, 1);
  SmallSystem    system(one, 0. * one, one);
  system.set_law(VectorXd::Ones(1), law_of([](double u) { return -u * u * u; }, [](double u) { return -3. * u * u; }));
  DescribedForces          described(system, VectorXd::Constant(1, 2.));
  const double             u_0 = 0.3, A = 0.7;
  const DescribingFunction found = described.at(VectorXd::Constant(1, u_0), A, 1.);
  // (u_0 + 2A c)^3: mean u_0^3 + 3/2 u_0 (2A)^2, first harmonic 3 u_0^2 2A + 3/4 (2A)^3, both seen through d = 2
  EXPECT_NEAR(found.mean, 2. * (std::pow(u_0, 3) + 6. * u_0 * A * A), 1e-12);
  EXPECT_NEAR(found.stiffness, 4. * (3. * u_0 * u_0 + 3. * A * A), 1e-12);
  EXPECT_NEAR(described.mean_forces()[0], -(std::pow(u_0, 3) + 6. * u_0 * A * A), 1e-12);
}

} // namespace gestell::tests
