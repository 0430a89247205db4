#include "coupling/integration/events/event_driver.h"
#include "coupling/integration/propagation/modal_propagation.h"
#include "tests/support/refusal.h"
#include "tests/support/small_system.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace coupling;
using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

Matrix one_by_one(double x)
{
  return Matrix::Constant(1, 1, x);
}

ModalPropagation::Options fixed(double h, ForceRule force = ForceRule::collocation, int order = 6)
{
  ModalPropagation::Options options;
  options.force = force;
  options.order = order;
  options.step  = h;
  return options;
}

void run_to(TimeIntegrator &integrator, double end, double h)
{
  while (integrator.time() < end - 0.5 * h)
    integrator.advance();
}

// --- the linear system is carried exactly, whatever the step

/// Exact motion of a mass with s^2 + 2 zeta w s + w^2 = 0 from (q0, v0).
std::pair<double, double> free_motion(double w, double zeta, double q0, double v0, double t)
{
  const std::complex<double> root = std::sqrt(std::complex<double>(zeta * zeta - 1.));
  const std::complex<double> a = w * (-zeta + root), b = w * (-zeta - root);
  const std::complex<double> A = (v0 - b * q0) / (a - b), B = q0 - A;
  return {(A * std::exp(a * t) + B * std::exp(b * t)).real(),
          (A * a * std::exp(a * t) + B * b * std::exp(b * t)).real()};
}

TEST(Exact, FreeVibrationHasNoErrorAtAnyStep)
{
  for (const double zeta : {0., 0.01, 0.9, 1.5})
    for (const double h : {0.01, 1., 50.})
    {
      const double     w = 3.;
      SmallSystem      system(one_by_one(2.), one_by_one(2. * 2. * zeta * w), one_by_one(2. * w * w));
      ModalPropagation exact(system, fixed(h));
      exact.begin(0., Vector::Constant(1, 0.3), Vector::Constant(1, -0.4));
      for (int k = 0; k < 10; ++k)
        exact.advance();
      const auto [q, v] = free_motion(w, zeta, 0.3, -0.4, 10. * h);
      EXPECT_NEAR(exact.instant().q[0], q, 1e-12) << zeta << " " << h;
      EXPECT_NEAR(exact.instant().v[0], v, 1e-12) << zeta << " " << h;
    }
}

TEST(Exact, CriticalDampingLosesNoMoreThanItsEigenvectorsDo)
{
  const double     w = 3., h = 0.1;
  SmallSystem      system(one_by_one(1.), one_by_one(2. * w), one_by_one(w * w));
  ModalPropagation exact(system, fixed(h));
  exact.begin(0., Vector::Constant(1, 1.), Vector::Constant(1, 0.));
  run_to(exact, 1., h);
  // sqrt of the distance kept from critical damping, 1e-6, divides the rounding
  EXPECT_NEAR(exact.instant().q[0], std::exp(-w) * (1. + w), 1e-9);
}

TEST(Exact, CoupledDampingAndHarmonicsAreExact)
{
  // q = forced motion, known in closed form: Re(Q e^(i Omega t)), started on it.
  Matrix M(2, 2), B(2, 2), C(2, 2);
  M << 2., 0.3, 0.3, 1.;
  B << 4., -1., -1., 2.5;
  C << 6000., -2000., -2000., 2500.;
  SmallSystem system(M, B, C);
  system.loads().add_harmonic(0, 20., 100., 0.);
  system.loads().add_harmonic(1, 33., 0., 40.);
  const std::complex<double> i(0., 1.);
  const auto                 forced = [&](double t, Vector &q, Vector &v)
  {
    q.setZero(2);
    v.setZero(2);
    for (const auto &[omega, load] :
         {std::pair(20., Eigen::Vector2cd(100., 0.)), std::pair(33., Eigen::Vector2cd(0., -40. * i))})
    {
      const Eigen::Matrix2cd K = (C - omega * omega * M).cast<std::complex<double>>() + i * omega * B;
      const Eigen::Vector2cd Q = K.inverse() * load * std::exp(i * omega * t);
      q += Q.real();
      v += (i * omega * Q).real();
    }
  };
  Vector q, v;
  forced(0.2, q, v);
  ModalPropagation exact(system, fixed(0.13));
  exact.begin(0.2, q, v);
  for (int k = 0; k < 20; ++k)
    exact.advance();
  forced(exact.time(), q, v);
  EXPECT_LT((exact.instant().q - q).norm(), 1e-12 * 20.);
  EXPECT_LT((exact.instant().v - v).norm(), 1e-12 * 20. * 33.);
}

TEST(Exact, FreeDrivesTurnExactly)
{
  // Two rotors joined by spring and damper turn freely together under a constant torque; a third is braked by a damper.
  Matrix M = Vector(Eigen::Vector3d(2., 3., 0.5)).asDiagonal(), B = Matrix::Zero(3, 3), C = B;
  B.topLeftCorner(2, 2) << 1., -1., -1., 1.;
  B(2, 2) = 0.7;
  C.topLeftCorner(2, 2) << 50., -50., -50., 50.;
  SmallSystem system(M, B, C);
  system.loads().add_constant(0, 4.);
  system.loads().add_constant(1, 6.);
  system.loads().add_constant(2, 1.4);
  ModalPropagation exact(system, fixed(0.5));
  // the torque 4 / 2 = 6 / 3 accelerates both alike
  exact.begin(0., Eigen::Vector3d(0.1, 0.1, 1.), Eigen::Vector3d(3., 3., 0.));
  run_to(exact, 10., 0.5);
  const double t = 10., decay = std::exp(-1.4 * t);
  EXPECT_NEAR(exact.instant().q[0], 0.1 + 3. * t + t * t, 1e-11 * 130.);
  EXPECT_NEAR(exact.instant().q[1], 0.1 + 3. * t + t * t, 1e-11 * 130.);
  EXPECT_NEAR(exact.instant().v[0], 3. + 2. * t, 1e-12 * 23.);
  EXPECT_NEAR(exact.instant().q[2], 1. + 2. * t - 2. * (1. - decay) / 1.4, 1e-11 * 20.);
  EXPECT_NEAR(exact.instant().v[2], 2. * (1. - decay), 1e-12 * 2.);
}

TEST(Exact, AMasslessCoordinateIsRefusedByName)
{
  SmallSystem system(Vector(Eigen::Vector2d(1., 0.)).asDiagonal(), Matrix::Identity(2, 2), Matrix::Identity(2, 2));
  expect_refusal([&] { ModalPropagation(system, fixed(0.1)); }, "q1");
}

TEST(Exact, UndampedResonanceIsRefused)
{
  SmallSystem system(one_by_one(1.), one_by_one(0.), one_by_one(9.));
  system.loads().add_harmonic(0, 3., 1., 0.);
  EXPECT_THROW(ModalPropagation(system, fixed(0.1)), std::invalid_argument);
}

// --- forces of elements: order

void cubic(double u, double v, double &p, double &dp_du, double &dp_dv)
{
  p     = -8. * u * u * u - 0.1 * v;
  dp_du = -24. * u * u;
  dp_dv = -0.1;
}

SmallSystem duffing_chain()
{
  Matrix M(2, 2), B(2, 2), C(2, 2);
  M << 1., 0.1, 0.1, 0.5;
  B << 0.3, -0.1, -0.1, 0.2;
  C << 40., -15., -15., 20.;
  SmallSystem system(M, B, C);
  system.loads().add_harmonic(0, 4., 2., 0.);
  system.set_law(Eigen::Vector2d(1., -1.), cubic);
  return system;
}

/// States at t = 0.4, 0.8, ... 4, one below the other.
Vector states(ForceRule force, int order, double h)
{
  const SmallSystem         system  = duffing_chain();
  ModalPropagation::Options options = fixed(h, force, order);
  options.newton.tolerance          = 1e-14;
  ModalPropagation exact(system, options);
  exact.begin(0., Eigen::Vector2d(0.5, -0.3), Eigen::Vector2d(0., 1.));
  Vector all(40);
  for (int k = 0; k < 10; ++k)
  {
    run_to(exact, 0.4 * (k + 1), h);
    all.segment(4 * k, 4) << exact.instant().q, exact.instant().v;
  }
  return all;
}

struct Rule
{
  ForceRule force;
  int       order;
  double    h;
};

using ExactOrder = ::testing::TestWithParam<Rule>;

TEST_P(ExactOrder, ErrorFallsWithThePowerOfTheStep)
{
  const auto [force, order, h] = GetParam();
  const Vector fine            = states(ForceRule::collocation, 8, 0.005);
  const double coarse = (states(force, order, h) - fine).norm(), half = (states(force, order, 0.5 * h) - fine).norm();
  EXPECT_NEAR(std::log2(coarse / half), order, order < 8 ? 0.1 : 0.2) << coarse << " " << half;
}
INSTANTIATE_TEST_SUITE_P(Rules, ExactOrder,
                         ::testing::Values(Rule{ForceRule::average, 2, 0.01}, Rule{ForceRule::linear, 2, 0.01},
                                           Rule{ForceRule::collocation, 2, 0.01}, Rule{ForceRule::collocation, 4, 0.01},
                                           Rule{ForceRule::collocation, 6, 0.025},
                                           Rule{ForceRule::collocation, 8, 0.05}));

TEST(Exact, DenseOutputOfTheWholeMotionIsThatOfAStepEndingThere)
{
  const SmallSystem system = duffing_chain();
  for (const ForceRule force : {ForceRule::linear, ForceRule::average, ForceRule::collocation})
  {
    ModalPropagation exact(system, fixed(0.05, force));
    exact.begin(0., Eigen::Vector2d(0.5, -0.3), Eigen::Vector2d(0., 1.));
    for (int k = 0; k < 7; ++k)
      exact.advance();
    Vector       q(2), v(2);
    const double t = exact.step_begin() + 0.4 * (exact.time() - exact.step_begin());
    exact.interpolate(t, q, v);
    LocalState local;
    local.resize(1);
    exact.interpolate(t, local);
    // cubic through u, u' at the ends: h^4/384 u with u of some 10^4
    EXPECT_NEAR(q[0] - q[1], local.u[0], force == ForceRule::collocation ? 1e-8 : 2e-4);
    exact.interpolate(exact.time() * (1. - 1e-14), q, v);
    EXPECT_NEAR(q[0], exact.instant().q[0], 1e-11);
    exact.interpolate(exact.step_begin(), q, v);
    exact.cut(exact.step_begin());
    EXPECT_NEAR(q[0], exact.instant().q[0], 1e-13);
  }
}

// --- stability at contacts: a free mass against a spring of k h^2/m = 1e4, far beyond 2 sqrt(3)

double energy_after(ForceRule force, double omega_h, int steps)
{
  SmallSystem system(one_by_one(1.), one_by_one(0.), one_by_one(0.));
  system.set_law(Vector::Ones(1), law_of([omega_h](double u) { return -omega_h * omega_h * u; },
                                         [omega_h](double) { return -omega_h * omega_h; }));
  ModalPropagation exact(system, fixed(1., force));
  exact.begin(0., Vector::Constant(1, 1e-3), Vector::Constant(1, 1.));
  for (int k = 0; k < steps; ++k)
    exact.advance();
  const double u = exact.instant().q[0], v = exact.instant().v[0];
  return (omega_h * omega_h * u * u + v * v) / (omega_h * omega_h * 1e-6 + 1.);
}

// Over 1e-13 s the mass moves by less than its place is rounded to: a rate read from that would err by 2e-3 m/s.
TEST(Exact, DenseOutputOfAShortStepLosesNothingToRounding)
{
  for (const ForceRule rule : {ForceRule::collocation, ForceRule::linear, ForceRule::average})
  {
    SmallSystem system(one_by_one(1.), one_by_one(0.), one_by_one(0.));
    system.set_law(Vector::Ones(1), law_of([](double u) { return -100. * u; }, [](double) { return -100.; }));
    ModalPropagation exact(system, fixed(0.01, rule));
    exact.begin(0., Vector::Constant(1, 1.1), Vector::Constant(1, 0.1));
    exact.advance();
    exact.cut(1e-13);
    LocalState inside;
    inside.resize(system);
    for (const double share : {0.2, 0.5, 0.8})
    {
      exact.interpolate(share * 1e-13, inside);
      EXPECT_NEAR(inside.v[0], 0.1, 1e-10);
      EXPECT_NEAR(inside.u[0], 1.1, 1e-14);
    }
  }
}

TEST(Exact, AverageForceConservesTheEnergyOfAContactAtAnyStep)
{
  for (const double omega_h : {0.1, 3., 100.})
    EXPECT_NEAR(energy_after(ForceRule::average, omega_h, 500), 1., 1e-7) << omega_h;
}

TEST(Exact, AverageForceKeepsTheEnergyOfARattlingMassWithoutEvents)
{
  // A free mass between two stops, contacts of omega h = 0.3 .. 30 passed over: what is gained at one touch by the kink
  // inside a step may not add up.
  for (const double omega_h : {0.3, 3., 30.})
  {
    SmallSystem  system(one_by_one(1.), one_by_one(0.), one_by_one(0.));
    const double k = omega_h * omega_h, gap = 2.3;
    system.set_law(Vector::Ones(1),
                   [k, gap](double u, double, double &p, double &du, double &dv)
                   {
                     const double d = std::abs(u) - gap;
                     p              = d > 0. ? -std::copysign(k * d, u) : 0.;
                     du             = d > 0. ? -k : 0.;
                     dv             = 0.;
                   });
    ModalPropagation exact(system, fixed(1., ForceRule::average));
    exact.begin(0., Vector::Zero(1), Vector::Ones(1));
    double largest = 0.;
    for (int i = 0; i < 4000; ++i)
    {
      exact.advance();
      const double d = std::max(0., std::abs(exact.local().u[0]) - gap), v = exact.local().v[0];
      largest = std::max(largest, v * v + k * d * d);
    }
    EXPECT_LT(largest, 1.1) << omega_h; // 128 pieces meet the work at a kink to some 1e-5, some 1000 times
  }
}

TEST(Exact, LinearForceIsStableUpToTwoRootThree)
{
  const double limit = 2. * std::sqrt(3.);
  EXPECT_LT(energy_after(ForceRule::linear, 0.99 * limit, 2000), 1e3);
  EXPECT_GT(energy_after(ForceRule::linear, 1.01 * limit, 2000), 1e6);
}

// --- Newton

/// A chain of three masses: the first one sticks where it is, a cubic spring pulls the last one back.
class StuckChain : public SmallSystem
{
public:
  explicit StuckChain(double k) : SmallSystem(Matrix::Identity(3, 3), Matrix::Zero(3, 3), Matrix::Zero(3, 3))
  {
    C << 37.3, -k, 0., -k, 25.7, -7.3, 0., -7.3, 19.1;
    Matrix w = Matrix::Zero(3, 2);
    w(2, 0) = w(0, 1) = 1.;
    set_law(w.col(0), law_of([](double u) { return -u * u * u; }, [](double u) { return -3. * u * u; }));
    W = w.sparseView();
  }
  const std::vector<HeldMeasure> &held() const override { return held_; }

private:
  std::vector<HeldMeasure> held_{{1, 0.}};
};

// What is held never moves, so that rounding is all its motion: no measure of whether Newton has converged.
TEST(Exact, WhatSticksFromTheStartOnDoesNotKeepNewtonFromConverging)
{
  for (const ForceRule rule : {ForceRule::average, ForceRule::linear, ForceRule::collocation})
    for (const double h : {1e-2, 1e-3, 1e-4})
      for (double k = 1.; k < 20.; k *= 1.37)
      {
        StuckChain       system(k);
        ModalPropagation exact(system, fixed(h, rule));
        exact.begin(0., Vector::Zero(3), 0.3 * Vector::Unit(3, 1));
        for (int i = 0; i < 20; ++i)
          ASSERT_NO_THROW(exact.advance()) << h << " " << k;
        EXPECT_NEAR(exact.local().v[1], 0., 1e-14) << h << " " << k;
        EXPECT_EQ(exact.work().rejected, 0) << h << " " << k;
      }
}

/// End of x'' + x + x^3 = 0 from x = 1.
double end_of_duffing(const ModalPropagation::Options &options)
{
  SmallSystem system(one_by_one(1.), one_by_one(0.), one_by_one(1.));
  system.set_law(Vector::Ones(1), law_of([](double u) { return -u * u * u; }, [](double u) { return -3. * u * u; }));
  ModalPropagation exact(system, options);
  exact.begin(0., Vector::Ones(1), Vector::Zero(1));
  run_to(exact, 40., options.step);
  return exact.instant().q[0];
}

// What Newton leaves of a force counts (omega h)^-2 times more than what it moves in one step.
TEST(Exact, NewtonLeavesLittleBesideTheErrorOfFixedSteps)
{
  for (const int order : {6, 8})
    for (const double h : {0.1, 0.05, 0.025})
    {
      ModalPropagation::Options fine  = fixed(0.02, ForceRule::collocation, 8);
      fine.newton.tolerance           = 1e-13;
      ModalPropagation::Options tight = fixed(h, ForceRule::collocation, order);
      tight.newton.tolerance          = 1e-13;
      const double truth              = end_of_duffing(fine);
      const double own                = std::abs(end_of_duffing(tight) - truth);
      const double as_it_comes        = std::abs(end_of_duffing(fixed(h, ForceRule::collocation, order)) - truth);
      EXPECT_LT(as_it_comes, 2. * own + 1e-9) << order << " " << h;
    }
}

} // namespace
} // namespace gestell::tests
