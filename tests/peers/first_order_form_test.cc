// The machine as a first order system: what the libraries are given is the true Jacobian, and the condensed solver
// solves with it.

#include "apps/peers/first_order_form.h"
#include "tests/support/small_system.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using Eigen::MatrixXd;
using Eigen::VectorXd;
using peers::FirstOrderForm;

/// Three coupled masses, one of them on a cubic spring with quadratic damping.
SmallSystem chain()
{
  MatrixXd M(3, 3), B(3, 3), C(3, 3);
  M << 2., 0.3, 0., 0.3, 1., 0.1, 0., 0.1, 3.;
  B << 0.4, -0.1, 0., -0.1, 0.3, -0.05, 0., -0.05, 0.2;
  C << 5., -2., 0., -2., 7., -1., 0., -1., 4.;
  SmallSystem system(M, B, C);
  VectorXd    w(3);
  w << 1., -1., 0.5;
  system.set_law(w, [](double u, double v, double &p, double &dp_du, double &dp_dv)
                 { p = -3. * u * u * u - v * v * v - u * v, dp_du = -9. * u * u - v, dp_dv = -3. * v * v - u; });
  system.set_load([](double t) { return VectorXd::Constant(3, std::sin(2. * t)); });
  return system;
}

VectorXd some_state()
{
  VectorXd y(6);
  y << 0.7, -0.4, 0.2, 1.1, 0.3, -0.8;
  return y;
}

TEST(FirstOrderForm, JacobianIsTheDerivativeOfTheRate)
{
  const SmallSystem system = chain();
  FirstOrderForm    form(system);
  form.know_dense();
  const VectorXd y = some_state();
  MatrixXd       J(6, 6);
  form.linearise(0.3, y.data());
  form.rate_jacobian(J);

  const double d = 1e-5; // central quotient: d^2 |F'''| / 6 of 1e-9, rounding 1e-10
  for (int j = 0; j < 6; ++j)
  {
    VectorXd above = y, below = y, rate_above(6), rate_below(6);
    above[j] += d;
    below[j] -= d;
    form.rate(0.3, above.data(), rate_above.data());
    form.rate(0.3, below.data(), rate_below.data());
    EXPECT_LT((J.col(j) - (rate_above - rate_below) / (2. * d)).norm(), 1e-7) << "column " << j;
  }
}

TEST(FirstOrderForm, ResidualIsZeroForTheRate)
{
  const SmallSystem system = chain();
  FirstOrderForm    form(system);
  form.know_dense();
  const VectorXd y = some_state();
  VectorXd       rate(6), r(6);
  form.rate(0.3, y.data(), rate.data());
  form.residual(0.3, y.data(), rate.data(), r.data());

  EXPECT_LT(r.norm(), 1e-13);
  form.rate(0.3, y.data(), rate.data());
  EXPECT_EQ(rate.head(3), y.tail(3));
}

TEST(FirstOrderForm, CondensedSolverSolvesWithTheDenseMatrix)
{
  const SmallSystem system = chain();
  FirstOrderForm    form(system);
  form.know_dense();
  const VectorXd y = some_state();
  MatrixXd       J(6, 6);
  form.linearise(0.3, y.data());
  for (const double gamma : {1e-3, 0.2, 5.})
  {
    ASSERT_TRUE(form.factorise(gamma));
    const VectorXd b = VectorXd::LinSpaced(6, -1., 2.);
    VectorXd       x = b;
    form.solve_rate_form(x.data());
    form.rate_jacobian(J);
    EXPECT_LT((x - gamma * (J * x) - b).norm(), 1e-12 * b.norm()) << gamma;

    x = b;
    form.solve_residual_form(x.data());
    form.residual_jacobian(gamma, J);
    EXPECT_LT((J * x - b).norm(), 1e-12 * b.norm()) << gamma;
  }
}

TEST(FirstOrderForm, SolvesForDisplacementsOfASecondOrderMethod)
{
  const SmallSystem system = chain();
  FirstOrderForm    form(system);
  const VectorXd    y   = some_state();
  const double      w_M = 70., w_B = 9.;
  form.linearise(0.3, y.data());
  ASSERT_TRUE(form.factorise_displacements(w_M, w_B));
  const VectorXd b = VectorXd::LinSpaced(3, -1., 2.);
  VectorXd       x = b;
  form.solve_displacements(x.data());

  // The derivative of the residual along x, with v and a moving by w_B x and w_M x; central quotient.
  const double   d    = 1e-6;
  const VectorXd a    = VectorXd::Constant(3, 0.4);
  VectorXd       r[2] = {VectorXd(3), VectorXd(3)};
  for (const int k : {0, 1})
  {
    const double   s       = k == 0 ? -d : d;
    VectorXd       moved   = y;
    const VectorXd a_moved = a + s * w_M * x;
    moved.head(3) += s * x;
    moved.tail(3) += s * w_B * x;
    form.displacement_residual(0.3, moved.data(), a_moved.data(), r[k].data());
  }
  EXPECT_LT(((r[1] - r[0]) / (2. * d) - b).norm(), 1e-7);
}

/// The measure is held at a constant rate.
struct HeldChain : SmallSystem
{
  HeldChain() : SmallSystem(chain()) {}
  const std::vector<coupling::HeldMeasure> &held() const override { return held_; }
  std::vector<coupling::HeldMeasure>        held_ = {{0, 0.2}};
};

TEST(FirstOrderForm, HeldMeasuresAreNotAccelerated)
{
  const HeldChain system;
  FirstOrderForm  form(system);
  form.know_dense();
  const VectorXd y = some_state();
  VectorXd       rate(6);
  form.rate(0.3, y.data(), rate.data());
  const VectorXd w = MatrixXd(system.W);

  EXPECT_NEAR(w.dot(rate.tail(3)), 0., 1e-14);
  // Only the held force was added: M v' + B v + C q - f is along w.
  VectorXd f(3), rest;
  system.linear().excitation().at(0.3, f);
  rest                = system.M * rate.tail(3) + system.B * y.tail(3) + system.C * y.head(3) - f;
  const double held_p = rest.dot(w) / w.squaredNorm();
  EXPECT_LT((rest - held_p * w).norm(), 1e-13);
  coupling::LocalState local;
  local.resize(1);
  form.local_state(0.3, y.data(), local);
  EXPECT_NEAR(local.p[0], held_p, 1e-13);
}

TEST(FirstOrderForm, CondensedSolverHoldsMeasuresToo)
{
  const HeldChain system;
  FirstOrderForm  form(system);
  form.know_dense();
  const VectorXd y = some_state();
  MatrixXd       J(6, 6);
  form.linearise(0.3, y.data());
  form.rate_jacobian(J);
  ASSERT_TRUE(form.factorise(0.2));
  const VectorXd b = VectorXd::LinSpaced(6, -1., 2.);
  VectorXd       x = b;
  form.solve_rate_form(x.data());

  EXPECT_LT((x - 0.2 * (J * x) - b).norm(), 1e-12 * b.norm());
}

} // namespace
} // namespace gestell::tests
