#include "coupling/integration/newmark/newmark.h"
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

Vector pair(double x, double y)
{
  return (Vector(2) << x, y).finished();
}

/// Two masses driven towards q = (sin 2t, e^-t): the load is whatever that needs.
class DrivenPair : public SmallSystem
{
public:
  DrivenPair() : SmallSystem(matrix(2., 0.3, 1.), matrix(6., -1., 4.), matrix(300., -100., 250.))
  {
    set_load([this](double t) -> Vector { return M * a(t) + B * v(t) + C * q(t); });
  }
  static Vector q(double t) { return pair(std::sin(2. * t), std::exp(-t)); }
  static Vector v(double t) { return pair(2. * std::cos(2. * t), -std::exp(-t)); }
  static Vector a(double t) { return pair(-4. * std::sin(2. * t), std::exp(-t)); }

private:
  static Matrix matrix(double a, double b, double c) { return (Matrix(2, 2) << a, b, b, c).finished(); }
};

void stiffening(double u, double v, double &p, double &dp_du, double &dp_dv)
{
  p     = -4e3 * u * u * u - 3. * v;
  dp_du = -1.2e4 * u * u;
  dp_dv = -3.;
}

std::vector<Newmark::Options> family()
{
  Newmark::Options linear;
  linear.beta = 1. / 6.;
  return {Newmark::Options(),
          linear,
          Newmark::hht(-0.1),
          Newmark::hht(-1. / 3.),
          Newmark::generalised_alpha(0.),
          Newmark::generalised_alpha(0.8),
          Newmark::generalised_alpha(1.),
          Newmark::central_difference()};
}

TEST(Newmark, ParametersOfTheAlphaMethodsAreThoseOfTheirAuthors)
{
  // Chung & Hulbert: alpha_m = (2 rho - 1)/(rho + 1), alpha_f = rho/(rho + 1), beta = (1 - alpha_m + alpha_f)^2/4,
  // gamma = 1/2 - alpha_m + alpha_f
  const auto half = Newmark::generalised_alpha(0.5);
  EXPECT_DOUBLE_EQ(half.alpha_m, 0.);
  EXPECT_DOUBLE_EQ(half.alpha_f, 1. / 3.);
  EXPECT_DOUBLE_EQ(half.beta, 4. / 9.);
  EXPECT_DOUBLE_EQ(half.gamma, 5. / 6.);
  // Hilber, Hughes & Taylor: no averaging of the inertia
  const auto hht = Newmark::hht(-0.3);
  EXPECT_DOUBLE_EQ(hht.alpha_m, 0.);
  EXPECT_DOUBLE_EQ(hht.alpha_f, 0.3);
  EXPECT_DOUBLE_EQ(hht.beta, 0.4225);
  EXPECT_DOUBLE_EQ(hht.gamma, 0.8);
  // Second order: gamma = 1/2 - alpha_m + alpha_f, in all of them
  for (const auto &o : family())
    EXPECT_NEAR(o.gamma, 0.5 - o.alpha_m + o.alpha_f, 1e-15);
}

TEST(Newmark, CondensedStepSolvesTheWholeEquationOfTheStep)
{
  for (Newmark::Options o : family())
  {
    DrivenPair system;
    system.set_law(pair(1., -2.), stiffening);
    o.step             = 0.002; // central differences stand the stiffest spring met here
    o.newton.tolerance = 1e-13;
    Newmark newmark(system, o);
    newmark.begin(0., pair(0.1, 0.9), pair(2., -1.));
    newmark.advance();
    newmark.advance();
    const Instant before = newmark.instant();
    const Vector  a0     = newmark.acceleration();
    newmark.advance();
    const Instant now = newmark.instant();
    const Vector  a1  = newmark.acceleration();

    const double h = o.step;
    EXPECT_LT((now.q - before.q - h * before.v - h * h * ((0.5 - o.beta) * a0 + o.beta * a1)).norm(), 1e-14);
    EXPECT_LT((now.v - before.v - h * ((1. - o.gamma) * a0 + o.gamma * a1)).norm(), 1e-13);
    const auto mean = [&](const Vector &begin, const Vector &end) -> Vector
    { return (1. - o.alpha_f) * end + o.alpha_f * begin; };
    const auto force = [&](const Instant &at) -> Vector
    {
      Vector f(2);
      system.linear().excitation().at(at.t, f);
      double       p, du, dv;
      const Vector w = Matrix(system.W);
      stiffening(w.dot(at.q), w.dot(at.v), p, du, dv);
      EXPECT_NEAR(at.local.p[0], p, 1e-9 * std::abs(p));
      return f + w * p;
    };
    const Vector left = system.M * ((1. - o.alpha_m) * a1 + o.alpha_m * a0) + system.B * mean(before.v, now.v) +
                        system.C * mean(before.q, now.q);
    const Vector right = mean(force(before), force(now));
    EXPECT_LT((left - right).norm(), 1e-10 * right.norm()); // a = x/h^2 has lost five digits
  }
}

/// Displacement, velocity and the acceleration of the measures, after a transient of the acceleration carried (its
/// root at h -> 0 is at most 1/2 here).
TEST(Newmark, AccelerationOfTheMeasuresIsOfSecondOrderToo)
{
  for (Newmark::Options o : family())
  {
    if (o.alpha_m == 0.5) // rho_inf = 1: the transient does not decay
      continue;
    DrivenPair system;
    system.set_law(pair(1., -2.),
                   [](double, double, double &p, double &dp_du, double &dp_dv) { p = dp_du = dp_dv = 0.; });
    const auto errors = [&](double h)
    {
      o.step = h;
      Newmark newmark(system, o);
      newmark.begin(0., DrivenPair::q(0.), DrivenPair::v(0.));
      Eigen::Array3d largest = Eigen::Array3d::Zero();
      while (newmark.time() < 2. - 0.5 * h)
      {
        newmark.advance();
        const double t = newmark.time();
        if (t > 1.)
          largest = largest.max(Eigen::Array3d((newmark.instant().q - DrivenPair::q(t)).norm(),
                                               (newmark.instant().v - DrivenPair::v(t)).norm(),
                                               std::abs(newmark.local().a[0] - pair(1., -2.).dot(DrivenPair::a(t)))));
      }
      return largest;
    };
    const Eigen::Array3d order = (errors(1. / 200.) / errors(1. / 400.)).log() / std::log(2.);
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(order[i], 2., 0.15) << "beta " << o.beta << " derivative " << i;
  }
}

TEST(Newmark, AverageAccelerationKeepsTheEnergyOfAnUndampedSystem)
{
  DrivenPair system;
  system.B.setZero();
  system.set_load([](double) -> Vector { return Vector::Zero(2); });
  Newmark::Options o;
  o.step = 0.5; // coarse on purpose: the fastest omega h is 9
  Newmark newmark(system, o);
  newmark.begin(0., pair(0.3, -0.1), pair(1., 2.));
  const auto energy = [&]
  {
    const Instant &now = newmark.instant();
    return 0.5 * (now.v.dot(system.M * now.v) + now.q.dot(system.C * now.q));
  };
  const double at_first = energy();
  for (int i = 0; i < 1000; ++i)
    newmark.advance();
  EXPECT_NEAR(energy(), at_first, 1e-11 * at_first);
}

/// A mass pulled over a belt by spring and load, sticking to it.
class Sticking : public DrivenPair
{
public:
  Sticking() { W = Matrix(pair(1., -1.)).sparseView(); }
  const std::vector<HeldMeasure> &held() const override { return sticking; }
  void                            force(const LocalState &, Vector &) const override {}
  void tangent(const LocalState &, double, double, double, Vector &, Matrix &dp) const override { dp.setZero(); }
  std::vector<HeldMeasure> sticking{{0, 0.25}};
};

TEST(Newmark, AMeasureThatSticksKeepsItsRateAndItsForceIsTheReaction)
{
  Sticking system;
  // With q1 - q2 held at the rate 0.25 one motion is left, s = q1 + q2: here s = sin 3t, q1 - q2 = 0.1 + 0.25 t.
  const auto q = [](double t)
  { return pair(0.5 * (std::sin(3. * t) + 0.1 + 0.25 * t), 0.5 * (std::sin(3. * t) - 0.1 - 0.25 * t)); };
  const auto v = [](double t)
  { return pair(0.5 * (3. * std::cos(3. * t) + 0.25), 0.5 * (3. * std::cos(3. * t) - 0.25)); };
  const auto a = [](double t) { return pair(-4.5 * std::sin(3. * t), -4.5 * std::sin(3. * t)); };
  const auto p = [](double t) { return 7. + 2. * std::cos(t); };
  system.set_load([&](double t) -> Vector
                  { return system.M * a(t) + system.B * v(t) + system.C * q(t) - pair(1., -1.) * p(t); });
  for (Newmark::Options o : family())
  {
    const auto errors = [&](double h)
    {
      o.step = h;
      Newmark newmark(system, o);
      newmark.begin(0., q(0.), v(0.));
      EXPECT_NEAR(newmark.local().p[0], 9., 1e-10);
      std::pair<double, double> largest{0., 0.};
      while (newmark.time() < 1. - 0.5 * h)
      {
        newmark.advance();
        const double t = newmark.time();
        EXPECT_NEAR(newmark.local().v[0], 0.25, 1e-11);
        largest.first  = std::max(largest.first, (newmark.instant().q - q(t)).norm());
        largest.second = std::max(largest.second, std::abs(newmark.local().p[0] - p(t)));
      }
      return largest;
    };
    const auto coarse = errors(1. / 200.), fine = errors(1. / 400.);
    EXPECT_NEAR(std::log2(coarse.first / fine.first), 2., 0.15) << o.beta << " " << o.gamma;
    EXPECT_LT(coarse.second, 0.3) << o.beta << " " << o.gamma;
    EXPECT_LT(fine.second, 0.6 * coarse.second) << o.beta << " " << o.gamma; // converges, at least with the step
  }
}

TEST(Newmark, RefusesParametersOutsideTheirRange)
{
  const DrivenPair system;
  const double     nan  = std::numeric_limits<double>::quiet_NaN();
  const auto       with = [&](auto change)
  {
    Newmark::Options o;
    o.step = 0.01;
    change(o);
    Newmark(system, o);
  };
  EXPECT_NO_THROW(with([](auto &) {}));
  for (const double bad : {-1e-9, nan})
    EXPECT_THROW(with([bad](auto &o) { o.beta = bad; }), std::invalid_argument);
  for (const double bad : {0., -0.5, nan})
    EXPECT_THROW(with([bad](auto &o) { o.gamma = bad; }), std::invalid_argument);
  for (const double bad : {1., nan})
    EXPECT_THROW(with([bad](auto &o) { o.alpha_m = bad; }), std::invalid_argument);
  for (const double bad : {-0.1, 1., nan})
    EXPECT_THROW(with([bad](auto &o) { o.alpha_f = bad; }), std::invalid_argument);
  for (const double bad : {0., -1., nan, std::numeric_limits<double>::infinity()})
    EXPECT_THROW(with([bad](auto &o) { o.step = bad; }), std::invalid_argument);
  for (const double bad : {0.01, -0.34, nan})
    EXPECT_THROW(Newmark::hht(bad), std::invalid_argument);
  for (const double bad : {-0.01, 1.01, nan})
    EXPECT_THROW(Newmark::generalised_alpha(bad), std::invalid_argument);
  EXPECT_EQ(refusal([] { Newmark::hht(0.05); }), "HHT: alpha is 0.05; it must be between -1/3 and 0");
}

} // namespace
} // namespace gestell::tests
