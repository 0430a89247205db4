// How points and directions of bodies follow their measures, against difference quotients.

#include "mechanism/facets.h"
#include "mechanism/joints/orthonormal_directors.h"
#include "mechanism/measures/point_along.h"
#include "mechanism/measures/relative_measure.h"
#include "tests/support/test.h"

#include <Eigen/Geometry>

namespace gestell::tests
{
namespace
{

using Eigen::Matrix3d, Eigen::VectorXd;
using mechanism::OrthonormalDirectors;
using mechanism::PlacedMeasure;
using mechanism::Placement;
using mechanism::RelativeMeasure;
using mechanism::Vector3d;
using Form = RelativeMeasure::Form;

const Vector3d point(0.4, -0.3, 0.7), centre(0.1, 0.2, -0.1), axis = Vector3d(1., 2., -2.) / 3.;

/// One placement of every kind.
std::vector<Placement> placements()
{
  std::vector<Placement::LinearMeasure> guide = {{Vector3d(0., 1., 0.), Vector3d(0.2, 0., 0.1)},
                                                 {Vector3d(1., 0., 0.), Vector3d::Zero()},
                                                 {Vector3d::Zero(), Vector3d(0., 0.3, 0.)}};
  return {Placement(point), Placement(point, centre, guide), Placement(point, centre, guide, axis),
          Placement::free(point, centre)};
}

/// Numbers of either sign without any order, the same in every run.
VectorXd numbers(int n, double first)
{
  VectorXd x(n);
  for (int i = 0; i < n; ++i)
    x[i] = 0.4 * std::sin(first + 1.7 * i * i);
  return x;
}

/// A smooth motion of measures: u + t v + t^2/2 a.
struct Path
{
  explicit Path(int n) : u(numbers(n, 0.3)), v(numbers(n, 1.1)), a(numbers(n, 2.3)) {}
  VectorXd u, v, a;
  VectorXd at(double t) const { return u + t * v + 0.5 * t * t * a; }
};

constexpr double h = 1e-4;

TEST(Placement, PositionsAndDirectionsMoveAsTheirDerivativesSay)
{
  for (const Placement &placement : placements())
  {
    const int              n = placement.n_measures();
    const Path             path(n);
    const auto             position = [&](double t) { return placement.position(path.at(t).data()); };
    const auto             turned   = [&](double t) { return placement.direction(axis, path.at(t).data()); };
    Placement::MovedVector x, e;
    placement.position(path.u.data(), path.v.data(), x);
    placement.direction(axis, path.u.data(), path.v.data(), e);
    const auto check = [&](const Placement::MovedVector &moved, const std::function<Vector3d(double)> &of)
    {
      EXPECT_LT((moved.value - of(0.)).norm(), 1e-15);
      // Central quotients: h^2/6 of the third derivative, and rounding over h and h^2.
      EXPECT_LT((moved.rate - (of(h) - of(-h)) / (2. * h)).norm(), 1e-8);
      EXPECT_LT((moved.J * path.v - moved.rate).norm(), 1e-14);
      EXPECT_LT((moved.J * path.a + moved.bias - (of(h) - 2. * of(0.) + of(-h)) / (h * h)).norm(), 1e-6);
    };
    check(x, position);
    check(e, turned);
  }
}

// The same numbers in another order of summation.
TEST(Placement, APointAlongAFixedDirectionIsThatOfThePlacement)
{
  const Vector3d a(0.3, -1.2, 0.7);
  auto           all = placements();
  all.emplace_back(point, centre, std::vector<Placement::LinearMeasure>{{Vector3d::UnitX(), Vector3d::Zero()}}, axis);
  for (const Placement &placement : all)
  {
    const int              n = placement.n_measures();
    const Path             path(n);
    Placement::MovedVector x;
    placement.position(path.u.data(), path.v.data(), x);
    const mechanism::PointAlong along(placement, a);
    const auto                  turn     = mechanism::PointAlong::turn(placement, path.u.data());
    VectorXd                    gradient = VectorXd::Zero(2 * n);
    EXPECT_NEAR(along.value(path.u.data(), turn, gradient.data(), 2), a.dot(x.value), 1e-14);
    EXPECT_NEAR(along.bias(path.u.data(), path.v.data(), turn), n > 0 ? a.dot(x.bias) : 0., 1e-14);
    for (int i = 0; i < n; ++i)
    {
      EXPECT_NEAR(gradient[2 * i], a.dot(x.J.col(i)), 1e-14) << i;
      EXPECT_EQ(gradient[2 * i + 1], 0.);
      EXPECT_EQ(along.depends(i), gradient[2 * i] != 0.) << i;
    }
  }
  EXPECT_FALSE(mechanism::PointAlong(all.back(), Vector3d::UnitZ()).depends(0)) << "it slides along x";
}

TEST(Placement, SmallMotionsAreThoseOfTranslationAndRotation)
{
  for (const Placement &placement : placements())
  {
    const VectorXd         zero = VectorXd::Zero(placement.n_measures());
    Placement::MovedVector x;
    placement.position(zero.data(), zero.data(), x);
    Vector3d turn = Vector3d::Zero();
    // A rigid body's directors turn together: three of its measures by d_i = theta x e_i.
    const Vector3d theta(0.3, -0.5, 0.2);
    VectorXd       rigid = zero;
    for (int i = 0; placement.n_measures() == 12 && i < 3; ++i)
      rigid.segment<3>(3 + 3 * i) = theta.cross(Vector3d::Unit(i));
    for (int i = 0; i < placement.n_measures(); ++i)
    {
      turn += rigid[i] * placement.rotation(i);
      if (placement.n_measures() == 12)
        continue;
      EXPECT_LT((x.J.col(i) - placement.translation(i) - placement.rotation(i).cross(point - centre)).norm(), 1e-15);
    }
    if (placement.n_measures() == 12)
    {
      EXPECT_LT((turn - theta).norm(), 1e-15);
      EXPECT_LT((x.J * rigid - theta.cross(point - centre)).norm(), 1e-15);
    }
  }
}

/// s' = G v and s'' = G a + bias along the path, by central quotients.
void expect_derivatives(const PlacedMeasure &placed, const Path &path, int which)
{
  double     gradient[PlacedMeasure::max_measures];
  const auto s = [&](double t)
  {
    double unused[PlacedMeasure::max_measures];
    return placed.evaluate(path.at(t).data(), path.v.data(), unused).s;
  };
  const auto                 value = placed.evaluate(path.u.data(), path.v.data(), gradient);
  const Eigen::Map<VectorXd> G(gradient, placed.n_measures());
  EXPECT_NEAR(G.dot(path.v), value.rate, 1e-13) << which;
  EXPECT_NEAR((s(h) - s(-h)) / (2. * h), value.rate, 1e-6 * std::max(1., std::abs(value.rate))) << which;
  EXPECT_NEAR((s(h) - 2. * s(0.) + s(-h)) / (h * h), G.dot(path.a) + value.bias,
              1e-5 * std::max(1., std::abs(value.bias)))
      << which;
}

TEST(RelativeMeasure, EveryFormHasTheGradientAndTheBiasOfItsValue)
{
  const auto all = placements();
  for (const Form form : {Form::along, Form::square, Form::distance, Form::inclination, Form::angle})
    for (const auto carrier :
         {RelativeMeasure::Carrier::space, RelativeMeasure::Carrier::first, RelativeMeasure::Carrier::second})
      for (const Placement &first : all)
        for (const Placement &second : all)
        {
          RelativeMeasure measure;
          measure.form    = form;
          measure.carrier = carrier;
          measure.a       = Vector3d(2., -1., 2.) / 3.;
          measure.b       = Vector3d(2., 2., -1.) / 3.;
          PlacedMeasure placed{first, Placement(second), measure};
          const int     n = placed.n_measures();
          if (n == 0 || (&first == &second && n < 12))
            continue; // nothing moves, or the two places are one
          Path path(n);
          if (n == 24)
            path.u.tail(12) *= -0.5;
          expect_derivatives(placed, path, int(form));
        }
}

/// A body that tilts as well as it turns has one angle about an axis, not one for each direction across it.
TEST(RelativeMeasure, TheAngleDoesNotDependOnTheDirectionsItIsTakenBetween)
{
  const Vector3d  a(2. / 3., -1. / 3., 2. / 3.), b(2. / 3., 2. / 3., -1. / 3.), n = a.cross(b);
  const Matrix3d  tilted = (Eigen::AngleAxisd(0.3, (a + 0.2 * b).normalized()) * Eigen::AngleAxisd(1.1, n)).matrix();
  VectorXd        u      = VectorXd::Zero(12);
  const VectorXd  rest   = u;
  double          gradient[PlacedMeasure::max_measures], first = 0.;
  RelativeMeasure angle;
  angle.form                         = Form::angle;
  Eigen::Map<Matrix3d>(u.data() + 3) = tilted - Matrix3d::Identity();
  for (int turn = 0; turn < 12; ++turn)
  {
    angle.a = Eigen::AngleAxisd(0.5 * turn, n) * a;
    angle.b = Eigen::AngleAxisd(0.5 * turn, n) * b;
    const double s =
        PlacedMeasure{Placement(), Placement::free(point, centre), angle}.evaluate(u.data(), rest.data(), gradient).s;
    if (turn == 0)
      first = s;
    EXPECT_NEAR(s, first, 1e-15) << turn;
  }
  EXPECT_NEAR(first, 1.1, 0.05);
}

/// Wheels in mesh or with a belt: any combination of their measures, the line of centres, the other flank.
TEST(RelativeMeasure, AMeshHasTheGradientAndTheBiasOfItsValue)
{
  const auto all = placements();
  for (const auto &[form, reach, flank] :
       {std::tuple(Form::gear, -0.9, 0.), std::tuple(Form::gear, -0.85, 1.), std::tuple(Form::gear, -0.85, -0.9),
        std::tuple(Form::strand, 0., 1.), std::tuple(Form::strand, 0.4, 1.)})
    for (const Placement &second : all)
    {
      RelativeMeasure mesh;
      mesh.form = form;
      mesh.a    = Vector3d(2., -1., 2.) / 3.;
      mesh.b    = Vector3d(2., 2., -1.) / 3.;
      PlacedMeasure placed{Placement(Vector3d(-1., 0.5, -1.2), Vector3d(-1., 0.4, -1.), {}, axis), second, mesh};
      auto         &m = placed.measure;
      m.reach         = reach;
      m.flank         = flank;
      m.distance_0    = 1.;
      const int n     = placed.n_measures();
      for (int i = 0; i < n; ++i)
        m.ratios.push_back(std::cos(2. + 3.1 * i));
      const Path path(n);
      expect_derivatives(placed, path, n);
    }
}

TEST(RelativeMeasure, ASpinIsTheDifferenceOfTheAngularVelocitiesAlongItsDirection)
{
  RelativeMeasure spin;
  spin.form = Form::spin;
  spin.a    = Vector3d(2., -1., 2.) / 3.;
  const PlacedMeasure placed{Placement(point, centre, {}, axis), Placement::free(point, centre), spin};
  const Vector3d      omega(2., -3., 5.), rotation(0.9, -1.3, 0.4);
  const Matrix3d      directors = OrthonormalDirectors::measures(rotation) + Matrix3d::Identity();
  double              u[13] = {0.7}, v[13] = {1.9}, G[PlacedMeasure::max_measures];
  for (int i = 0; i < 3; ++i)
  {
    Eigen::Map<Vector3d>(u + 4 + 3 * i) = directors.col(i) - Vector3d::Unit(i);
    Eigen::Map<Vector3d>(v + 4 + 3 * i) = omega.cross(directors.col(i));
  }
  const auto value = placed.evaluate(u, v, G);
  EXPECT_NEAR(value.rate, spin.a.dot(omega - 1.9 * axis), 1e-13);
  EXPECT_NEAR((Eigen::Map<VectorXd>(G, 13).dot(Eigen::Map<VectorXd>(v, 13))), value.rate, 1e-13);
}

// --- directors

/// Directors turned by a rotation, less their described directions; angular velocity omega.
struct Turned
{
  Turned(const Vector3d &rotation, const Vector3d &omega)
      : u(OrthonormalDirectors::measures(rotation)), R(u + Matrix3d::Identity())
  {
    for (int i = 0; i < 3; ++i)
      v.col(i) = omega.cross(R.col(i));
  }
  mechanism::LocalMotion motion() const { return {0., u.data(), v.data(), nullptr}; }

  Matrix3d u, R, v;
};

const Vector3d turn(0.9, -1.3, 0.4), omega(2., -3., 5.);

TEST(OrthonormalDirectors, AreThoseOfARotation)
{
  const Turned               turned(turn, omega);
  const OrthonormalDirectors directors;
  double                     g[6], G[54], rate[6], bias[6];
  directors.constraint(turned.motion(), nullptr, g, G);
  directors.constraint_rates(turned.motion(), nullptr, rate, bias);
  const Eigen::Map<Eigen::Matrix<double, 6, 9>> gradient(G);
  const Eigen::Map<const VectorXd>              v(turned.v.data(), 9);
  // A rotation at the acceleration d_i'' = omega x (omega x d_i) keeps all three orders.
  VectorXd a(9);
  for (int i = 0; i < 3; ++i)
    a.segment<3>(3 * i) = omega.cross(omega.cross(turned.R.col(i)));
  for (int r = 0; r < 6; ++r)
  {
    EXPECT_NEAR(g[r], 0., 1e-15);
    EXPECT_NEAR(gradient.row(r).dot(v) + rate[r], 0., 1e-14);
    EXPECT_NEAR(gradient.row(r).dot(a) + bias[r], 0., 1e-13);
  }
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_NEAR(directors.quantity(i, turned.motion(), nullptr), omega[i], 1e-14);
    EXPECT_NEAR(directors.quantity(3 + i, turned.motion(), nullptr), turn[i], 1e-15);
  }
}

TEST(OrthonormalDirectors, DerivativesAreThoseOfTheEquations)
{
  const OrthonormalDirectors directors;
  VectorXd                   u = numbers(9, 0.7), v = numbers(9, 1.9), lambda = numbers(6, 2.9);
  double                     g[6], G[54], plus[6], minus[6], unused[54], K[81];
  directors.constraint({0., u.data(), v.data(), nullptr}, nullptr, g, G);
  mechanism::LocalMotion motion{0., u.data(), v.data(), nullptr};
  motion.lambda = lambda.data();
  mechanism::geometric(directors, motion, nullptr, K);
  for (int k = 0; k < 9; ++k)
  {
    double         G_plus[54], G_minus[54];
    const VectorXd up = u + h * VectorXd::Unit(9, k), down = u - h * VectorXd::Unit(9, k);
    directors.constraint({0., up.data(), v.data(), nullptr}, nullptr, plus, G_plus);
    directors.constraint({0., down.data(), v.data(), nullptr}, nullptr, minus, G_minus);
    for (int r = 0; r < 6; ++r) // quadratic: central quotients are exact but for rounding
      EXPECT_NEAR(G[r + 6 * k], (plus[r] - minus[r]) / (2. * h), 1e-11);
    for (int j = 0; j < 9; ++j)
    {
      double slope = 0.;
      for (int r = 0; r < 6; ++r)
        slope -= lambda[r] * (G_plus[r + 6 * j] - G_minus[r + 6 * j]) / (2. * h);
      EXPECT_NEAR(K[j + 9 * k], slope, 1e-11);
    }
  }
  const VectorXd next = u + h * v, last = u - h * v;
  double         rate[6], bias[6];
  directors.constraint({0., next.data(), v.data(), nullptr}, nullptr, plus, unused);
  directors.constraint({0., last.data(), v.data(), nullptr}, nullptr, minus, unused);
  directors.constraint_rates({0., u.data(), v.data(), nullptr}, nullptr, rate, bias);
  for (int r = 0; r < 6; ++r)
    EXPECT_NEAR(bias[r], (plus[r] - 2. * g[r] + minus[r]) / (h * h), 1e-6);
}

// What keeps a body rigid must not turn it: sum d_i x f_i = 0 for any multipliers.
TEST(OrthonormalDirectors, ForcesOfTheirMultipliersHaveNoTorque)
{
  const Turned               turned(turn, omega);
  const OrthonormalDirectors directors;
  double                     g[6], G[54];
  directors.constraint(turned.motion(), nullptr, g, G);
  const VectorXd f      = Eigen::Map<Eigen::Matrix<double, 6, 9>>(G).transpose() * numbers(6, 0.2);
  Vector3d       torque = Vector3d::Zero();
  for (int i = 0; i < 3; ++i)
    torque += turned.R.col(i).cross(f.segment<3>(3 * i));
  EXPECT_GT(f.norm(), 0.1);
  EXPECT_LT(torque.norm(), 1e-15);
}

} // namespace
} // namespace gestell::tests
