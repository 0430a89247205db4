#include "coupling/integration/bdf/bdf.h"
#include "tests/support/small_system.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace coupling;
using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

/// Two coupled masses, strongly damped so that every order is stable, driven by cos(3 t) towards the exact solution
/// q = (sin 2t, e^-t): the load is whatever that needs.
SmallSystem damped_chain()
{
  Matrix M(2, 2), B(2, 2), C(2, 2);
  M << 2., 0.3, 0.3, 1.;
  B << 60., -10., -10., 40.;
  C << 300., -100., -100., 250.;
  SmallSystem system(M, B, C);
  system.set_load(
      [=](double t) -> Vector
      {
        const Eigen::Vector2d q(std::sin(2. * t), std::exp(-t)), v(2. * std::cos(2. * t), -std::exp(-t)),
            a(-4. * std::sin(2. * t), std::exp(-t));
        return M * a + B * v + C * q;
      });
  return system;
}

/// Largest errors of displacement and velocity for 1 <= t <= 2.
std::pair<double, double> end_errors(int order, double h)
{
  const SmallSystem system = damped_chain();
  Bdf::Options      options;
  options.order = order;
  options.step  = h;
  Bdf bdf(system, options);
  bdf.begin(0., Eigen::Vector2d(0., 1.), Eigen::Vector2d(2., -1.));
  std::pair<double, double> largest{0., 0.};
  while (bdf.instant().t < 2. - 0.5 * h)
  {
    bdf.advance();
    const double t = bdf.instant().t;
    if (t < 1.) // the largest error of the second half: past what the start leaves behind
      continue;
    largest.first = std::max(largest.first, (bdf.instant().q - Eigen::Vector2d(std::sin(2. * t), std::exp(-t))).norm());
    largest.second =
        std::max(largest.second, (bdf.instant().v - Eigen::Vector2d(2. * std::cos(2. * t), -std::exp(-t))).norm());
  }
  return largest;
}

using BdfOrder = ::testing::TestWithParam<int>;

TEST_P(BdfOrder, ErrorFallsWithThePowerOfTheStep)
{
  const int    order  = GetParam();
  const double h      = order < 5 ? 1. / 200. : 1. / 50.; // above rounding for the high orders
  const auto   coarse = end_errors(order, h), fine = end_errors(order, h / 2.);
  EXPECT_NEAR(std::log2(coarse.first / fine.first), order, 0.15);
  EXPECT_NEAR(std::log2(coarse.second / fine.second), order, 0.15);
}
INSTANTIATE_TEST_SUITE_P(Orders, BdfOrder, ::testing::Values(1, 2, 3, 4, 5, 6));

/// Cubic spring on the second mass.
void stiffening(double u, double, double &p, double &dp_du, double &dp_dv)
{
  p     = -4e3 * u * u * u;
  dp_du = -1.2e4 * u * u;
  dp_dv = 0.;
}

TEST(Bdf, CondensedStepSolvesTheWholeEquationOfTheStep)
{
  SmallSystem system = damped_chain();
  system.set_law(Eigen::Vector2d(1., -2.), stiffening);
  Bdf                   bdf(system, {1, 0.01});
  const Eigen::Vector2d q0(0.1, 0.9), v0(2., -1.);
  bdf.begin(0., q0, v0);
  bdf.advance();
  // Order 1: A q = M q0 + h (M v0 + B q0) + h^2 (f + W p)   (5.5.2/13)
  const double  h = 0.01;
  const Vector &q = bdf.instant().q;
  double        p, du, dv;
  const Vector  w = system.W * Vector::Ones(1);
  Vector        load(2);
  system.linear().excitation().at(h, load);
  stiffening(w.dot(q), 0., p, du, dv);
  const Vector right = system.M * q0 + h * (system.M * v0 + system.B * q0) + h * h * (load + w * p);
  const Vector left  = system.M * q + h * (system.B * q) + h * h * (system.C * q);
  EXPECT_LT((left - right).norm(), 1e-12 * right.norm());
}

TEST(Bdf, OneFactorisationServesEveryStepOfAFixedSize)
{
  SmallSystem system = damped_chain();
  system.set_law(Eigen::Vector2d(1., -2.), stiffening);
  Bdf bdf(system, {2, 0.001});
  bdf.begin(0., Eigen::Vector2d(0., 1.), Eigen::Vector2d(2., -1.));
  for (int i = 0; i < 500; ++i)
    bdf.advance();
  EXPECT_EQ(bdf.work().factorisations, 4); // implicit Euler with h, h/2 and h/3 to start, then BDF2
  EXPECT_LE(bdf.work().newton, 3 * 500);
}

/// Duffing's oscillator at t = 10, and Newton iterations per step.
std::pair<double, double> duffing_by_share(double h, double share_of_error)
{
  SmallSystem system(Matrix::Identity(1, 1), 0.1 * Matrix::Identity(1, 1), Matrix::Identity(1, 1));
  system.set_load([](double t) -> Vector { return Vector::Constant(1, std::cos(1.2 * t)); });
  system.set_law(Vector::Ones(1), law_of([](double u) { return -u * u * u; }, [](double u) { return -3. * u * u; }));
  Bdf::Options options;
  options.step                  = h;
  options.newton.share_of_error = share_of_error;
  Bdf bdf(system, options);
  bdf.begin(0., Vector::Ones(1), Vector::Zero(1));
  while (bdf.instant().t < 10. - 0.5 * h)
    bdf.advance();
  return {bdf.instant().q[0], double(bdf.work().newton) / double(bdf.work().steps)};
}

TEST(Bdf, NewtonLeavesASmallShareOfTheErrorOfTheFormula)
{
  for (const double h : {0.02, 0.01, 0.005})
  {
    const auto [all, iterations_all]     = duffing_by_share(h, 0.);
    const auto [share, iterations_share] = duffing_by_share(h, 1e-3);
    const double truncation              = std::abs(all - duffing_by_share(h / 8., 0.).first);
    EXPECT_LT(std::abs(share - all), 0.01 * truncation) << "h = " << h; // 1e-3 of a correction of some errors
    EXPECT_GT(iterations_all, 1.9);
    EXPECT_LT(iterations_share, 1.2);
  }
}

TEST(Bdf, NewtonLeavesLittleOfTheMotionHoweverLargeTheErrorOfTheFormula)
{
  // Ten steps in a period: the formula errs by a tenth, Newton may leave 1e-7 of the excursion in each of 20 steps.
  EXPECT_LT(std::abs(duffing_by_share(0.5, 1e-3).first - duffing_by_share(0.5, 0.).first), 20. * 1e-7 * 1.5);
}

TEST(Bdf, NewtonBelievesOnlyInAContractionSeenSinceTheRestart)
{
  SmallSystem system = damped_chain();
  system.set_law(Eigen::Vector2d(1., -2.), law_of([](double u) { return -30. * u; }, [](double) { return -30.; }));
  Bdf bdf(system, {2, 0.01});
  bdf.begin(0., Eigen::Vector2d(0., 1.), Eigen::Vector2d(2., -1.));
  const auto iterations = [&bdf]
  {
    const long before = bdf.work().newton;
    bdf.advance();
    return bdf.work().newton - before;
  };
  for (const bool again : {false, true})
  {
    if (again)
      bdf.restart();
    for (int i = 0; i < 2; ++i) // until three points make good predictions
      bdf.advance();
    EXPECT_EQ(iterations(), 2) << again; // the second sees that the law is linear
    for (int i = 0; i < 5; ++i)
      EXPECT_EQ(iterations(), 1) << again;
  }
}

TEST(Bdf, RefusesOrdersAndStepsThatDoNotExist)
{
  const SmallSystem system = damped_chain();
  Bdf::Options      options;
  options.step = 0.01;
  for (const int order : {0, 7})
  {
    options.order = order;
    EXPECT_THROW(Bdf(system, options), std::invalid_argument);
  }
  options.order = 2;
  options.step  = 0.;
  EXPECT_THROW(Bdf(system, options), std::invalid_argument);
}

} // namespace
} // namespace gestell::tests
