#include "coupling/integration/newmark/wilson.h"
#include "tests/support/small_system.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace coupling;
using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

Vector one_entry(double x)
{
  return Vector::Constant(1, x);
}

/// A driven mass with a stiffening spring.
SmallSystem hardening()
{
  SmallSystem system(Matrix::Constant(1, 1, 2.), Matrix::Constant(1, 1, 0.5), Matrix::Constant(1, 1, 30.));
  system.set_law(one_entry(1.),
                 [](double u, double v, double &p, double &dp_du, double &dp_dv)
                 {
                   p     = -40. * u * u * u - 0.2 * v;
                   dp_du = -120. * u * u;
                   dp_dv = -0.2;
                 });
  system.loads().add_harmonic(0, 3., 5., 1.);
  return system;
}

TEST(Wilson, FulfilsTheEquationOfMotionAtTPlusThetaH)
{
  const SmallSystem system = hardening();
  for (const double theta : {1., 1.4, 2.})
  {
    Wilson::Options o;
    o.theta            = theta;
    o.step             = 0.02;
    o.newton.tolerance = 1e-13;
    Wilson wilson(system, o);
    wilson.begin(0., one_entry(0.4), one_entry(1.));
    wilson.advance();
    const Instant before = wilson.instant();
    const double  a0     = wilson.acceleration()[0];
    wilson.advance();
    const Instant now = wilson.instant();
    const double  a1  = wilson.acceleration()[0];

    const double h = o.step, tau = theta * h, a_theta = a0 + theta * (a1 - a0);
    EXPECT_NEAR(now.q[0], before.q[0] + h * before.v[0] + h * h * (2. * a0 + a1) / 6., 1e-15);
    EXPECT_NEAR(now.v[0], before.v[0] + 0.5 * h * (a0 + a1), 1e-15);
    const double q = before.q[0] + tau * before.v[0] + tau * tau * (2. * a0 + a_theta) / 6.;
    const double v = before.v[0] + 0.5 * tau * (a0 + a_theta);
    double       p, du, dv;
    Vector       f0(1), f1(1);
    system.law(q, v, p, du, dv);
    system.linear().excitation().at(before.t, f0);
    system.linear().excitation().at(now.t, f1);
    EXPECT_NEAR(2. * a_theta + 0.5 * v + 30. * q, f0[0] + theta * (f1[0] - f0[0]) + p, 1e-10);
    system.law(now.q[0], now.v[0], p, du, dv);
    EXPECT_DOUBLE_EQ(now.local.p[0], p);
  }
}

/// Two masses of which one sticks to the other, which slips away from it at 0.25 m/s.
class StickingMass : public SmallSystem
{
public:
  StickingMass() : SmallSystem(matrix(2., 0.3), matrix(6., -1.), matrix(300., -100.))
  {
    W = Matrix((Vector(2) << 1., -1.).finished()).sparseView();
    loads().add_harmonic(0, 5., 40., 0.);
  }
  const std::vector<HeldMeasure> &held() const override { return sticking; }
  void                            force(const LocalState &, Vector &) const override {}
  void tangent(const LocalState &, double, double, double, Vector &, Matrix &dp) const override { dp.setZero(); }
  std::vector<HeldMeasure> sticking{{0, 0.25}};

private:
  static Matrix matrix(double a, double b) { return (Matrix(2, 2) << a, b, b, a).finished(); }
};

TEST(Wilson, AMeasureThatSticksKeepsItsRate)
{
  const StickingMass system;
  Wilson::Options    o;
  o.step = 0.01;
  Wilson wilson(system, o);
  wilson.begin(0., Vector::Zero(2), (Vector(2) << 0.5, 0.25).finished());
  // The reaction: with s = q1 + q2, d = q1 - q2 = 0.25 t,  1.7 d'' + 7 d' + 400 d = f + 2 p
  for (int i = 0; i < 200; ++i)
  {
    wilson.advance();
    const double t = wilson.time();
    EXPECT_NEAR(wilson.local().v[0], 0.25, 1e-11);
    EXPECT_NEAR(wilson.local().u[0], 0.25 * t, 1e-11);
    // Linear over theta h, as are the forces balanced there: off by the bend of the load, theta^2 (h Omega)^2/8 of it,
    // and by as much at the other end.
    EXPECT_NEAR(wilson.local().p[0], 0.5 * (7. * 0.25 + 400. * 0.25 * t - 40. * std::cos(5. * t)), 0.5 * 0.0025 * 40.);
  }
}

TEST(Wilson, RefusesParametersOutsideTheirRange)
{
  const SmallSystem system = hardening();
  Wilson::Options   o;
  o.step = 0.01;
  EXPECT_NO_THROW(Wilson(system, o));
  for (const double bad : {0.99, 0., std::numeric_limits<double>::quiet_NaN()})
  {
    o.theta = bad;
    EXPECT_THROW(Wilson(system, o), std::invalid_argument);
  }
  o.theta = 1.;
  for (const double bad : {0., -1.})
  {
    o.step = bad;
    EXPECT_THROW(Wilson(system, o), std::invalid_argument);
  }
}

} // namespace
} // namespace gestell::tests
