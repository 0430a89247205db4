// Splines, position functions and sums of measures: orders, closure, derivatives against difference quotients.

#include "mechanism/joints/motion_law.h"
#include "mechanism/measures/combined_measure.h"

#include "tests/support/refusal.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace mechanism;

constexpr double pi = 3.14159265358979323846;

/// Largest errors of f, f', f'' of the spline through n points of sin(x + 1) on [0, 2 pi].
std::array<double, 3> spline_errors(int n, CubicSpline::Ends ends)
{
  std::vector<CubicSpline::Point> points;
  for (int i = 0; i <= n; ++i)
    points.push_back({2. * pi * i / n, std::sin(2. * pi * i / n + 1.)});
  const CubicSpline     spline(points, ends);
  std::array<double, 3> error{};
  for (int i = 0; i <= 1000; ++i)
  {
    const double x = 2. * pi * i / 1000.;
    const auto   f = spline.at(x);
    error[0]       = std::max(error[0], std::abs(f.value - std::sin(x + 1.)));
    error[1]       = std::max(error[1], std::abs(f.first - std::cos(x + 1.)));
    error[2]       = std::max(error[2], std::abs(f.second + std::sin(x + 1.)));
  }
  return error;
}

TEST(CubicSpline, IsOfOrderFourAndItsDerivativesOfThreeAndTwo)
{
  for (const auto ends : {CubicSpline::Ends::periodic, CubicSpline::Ends::not_a_knot})
  {
    const auto coarse = spline_errors(100, ends), fine = spline_errors(200, ends);
    for (int k = 0; k < 3; ++k) // 0.2: the next term, and where the largest error lies between two knots
      EXPECT_NEAR(std::log2(coarse[k] / fine[k]), 4. - k, 0.2) << k << ": " << fine[k];
  }
}

TEST(CubicSpline, IsTwiceContinuousAtKnotsAndAcrossThePeriod)
{
  const CubicSpline spline({{0., 1.}, {0.7, 2.}, {1.1, -1.}, {2.5, 0.4}, {3., 1.5}}, CubicSpline::Ends::periodic);
  const double      step = 1e-9;
  for (const double knot : {0., 0.7, 1.1, 2.5, 3., 6.})
  {
    const auto left = spline.at(knot - step), right = spline.at(knot + step);
    // The function moves by f' 2e-9, f'' by f''' 2e-9, of the order of 100.
    EXPECT_NEAR(left.value, right.value, 1e-7) << knot;
    EXPECT_NEAR(left.first, right.first, 1e-6) << knot;
    EXPECT_NEAR(left.second, right.second, 1e-5) << knot;
  }
  EXPECT_NEAR(spline.at(1.3 + 30.).value, spline.at(1.3).value + 10. * 0.5, 1e-12); // ten periods, raised by 0.5 each
  EXPECT_NEAR(spline.at(1.3 - 3.).value, spline.at(1.3).value - 0.5, 1e-12);
}

TEST(CubicSpline, ReproducesACubicAndRefusesRowsThatDoNotAscend)
{
  const auto  cubic = [](double x) { return 1. - x + 2. * x * x - 0.3 * x * x * x; };
  CubicSpline spline({{0., cubic(0.)}, {1., cubic(1.)}, {1.5, cubic(1.5)}, {4., cubic(4.)}},
                     CubicSpline::Ends::not_a_knot);
  EXPECT_NEAR(spline.at(2.7).value, cubic(2.7), 1e-13);
  EXPECT_NEAR(spline.at(0.2).second, 4. - 1.8 * 0.2, 1e-12);
  const auto rows = [](double x) { CubicSpline({{0., 0.}, {1., 1.}, {x, 2.}}, CubicSpline::Ends::not_a_knot); };
  expect_refusal([&] { rows(1.); }, "row 3, abscissa = 1, but it must be above 1");
  expect_refusal([&] { CubicSpline({{0., 0.}, {1., 1.}}, CubicSpline::Ends::periodic); }, "number of rows = 2");
}

// --- position functions

TEST(PositionFunction, GoesOnFromPeriodToPeriodRaised)
{
  const Formula          x = Formula::variable(0);
  const PositionFunction f(0.5 * x + 0.3 * applied(Function::sin, x), PositionFunction::Period{2. * pi, -1., pi});
  EXPECT_EQ(f.n_guards(), 0);
  for (const double at : {-1., 0.4, 5., 20., -13.})
  {
    const auto value = f.at(at);
    EXPECT_NEAR(value.value, 0.5 * at + 0.3 * std::sin(at), 1e-13);
    EXPECT_NEAR(value.first, 0.5 + 0.3 * std::cos(at), 1e-13);
    EXPECT_NEAR(value.second, -0.3 * std::sin(at), 1e-13);
  }
  const auto opened = [&](const Formula &g, double rise) {
    return refusal([&] { PositionFunction(g, PositionFunction::Period{1., 0., rise}); });
  };
  EXPECT_NE(opened(x, 0.5).find("value at the end of the period"), std::string::npos);
  EXPECT_NE(opened(x * x, 1.).find("slope at the end of the period"), std::string::npos);
  EXPECT_NE(opened(power(x - 0.5, 3.), 0.25).find("second derivative"), std::string::npos);
  const Formula turn = 2. * pi * x; // flat and zero at both ends: what is left there is rounding
  EXPECT_EQ(opened(1. - applied(Function::cos, turn), 0.), "");
  EXPECT_EQ(opened(abs(x - 0.5), 0.), ""); // its passage is an event, as its kink is
}

/// Drives f along x(t) and takes every transition that is due, as the event driver does.
int events_along(const PositionFunction &f, double from, double to)
{
  constexpr int       steps = 4000;
  std::vector<double> history(std::size_t(f.n_history())), g(std::size_t(f.n_guards()));
  const double        rate   = to > from ? 1. : -1.;
  int                 events = 0;
  f.start(from, rate, history.data());
  for (int n = 1; n <= steps; ++n)
  {
    const double x = from + (to - from) * n / steps;
    for (bool again = true; again;)
    {
      again            = false;
      const auto guard = f.guards(history.data());
      f.guard_values(x, history.data(), g.data());
      for (std::size_t i = 0; i < guard.size() && !again; ++i)
        if ((guard[i].crossing == Crossing::rising ? g[i] : -g[i]) > 1e-12)
        {
          f.transition(int(i), x, rate, history.data());
          ++events;
          again = true;
        }
    }
    EXPECT_NEAR(f.at(x, history.data()).value, f.at(x).value, 1e-12) << x;
    EXPECT_NEAR(f.at(x, history.data()).first, f.at(x).first, 1e-12) << x;
  }
  return events;
}

TEST(PositionFunction, PiecesFollowTheMotionForwardsAndBackwards)
{
  const Formula          x = Formula::variable(0);
  const PositionFunction indexing(max(x - 1., 0.) - max(x - 2.003, 0.), PositionFunction::Period{3., 0., 1.003});
  EXPECT_EQ(events_along(indexing, 0.5, 9.6), 3 * 3);          // two kinks and a passage in each of three periods
  EXPECT_EQ(events_along(indexing, 9.6, -0.5), 3 * 3 + 1 + 0); // back, and into the one before
  const PositionFunction table(CubicSpline({{0., 0.}, {1., 1.}, {2., 0.5}, {3., 2.}}, CubicSpline::Ends::not_a_knot));
  EXPECT_EQ(events_along(table, -1.003, 4.), 2);
  EXPECT_EQ(events_along(table, 4.003, -1.), 2);
  const auto end = table.at(3.), beyond = table.at(3.5);
  EXPECT_NEAR(beyond.value, end.value + 0.5 * end.first, 1e-13);
  EXPECT_EQ(beyond.second, 0.);
}

// --- sums of measures

/// 2 |d| of a body in a plane - 0.4 u - f(angle of its line), of 3 + 1 + 3 measures.
CombinedMeasure example()
{
  const Placement arm(Vector3d(0.5, 0.2, 0.), Vector3d(0.1, 0., 0.),
                      {{Vector3d::UnitX(), Vector3d::Zero()}, {Vector3d::UnitY(), Vector3d::Zero()}},
                      Vector3d::UnitZ());
  PlacedMeasure   distance, angle;
  distance.first = angle.first = arm;
  distance.second              = Placement(Vector3d(-0.3, 0.4, 0.));
  distance.measure.form        = RelativeMeasure::Form::distance;
  angle.second                 = Placement(Vector3d(0.2, -0.6, 0.));
  angle.measure.form           = RelativeMeasure::Form::inclination;
  angle.measure.a              = Vector3d::UnitX();
  angle.measure.b              = Vector3d::UnitY();
  const Formula x              = Formula::variable(0);
  return CombinedMeasure({{2., distance}, {-0.4, PlacedMeasure::linear()}}, angle,
                         std::make_shared<PositionFunction>(applied(Function::sin, 3. * x) + x * x));
}

TEST(CombinedMeasure, GradientCurvatureAndBiasAreThoseOfDifferences)
{
  using Vector                  = Eigen::Matrix<double, 7, 1>;
  const CombinedMeasure measure = example();
  ASSERT_EQ(measure.n_measures(), 7);
  Vector u, v, a;
  u << 0.1, -0.2, 0.4, 0.7, -0.1, 0.3, -0.5;
  v << 1., 0.3, -2., 0.5, 0.8, -0.6, 1.5;
  a << -1., 2., 0.5, 0.3, -0.7, 1.1, 0.9;
  const Vector zero = Vector::Zero();
  Vector       G, at;
  const auto   value = [&](const Vector &u) { return measure.evaluate(u.data(), zero.data(), at.data()).s; };
  const auto   now   = measure.evaluate(u.data(), v.data(), G.data());
  // Central quotients: h^2 times third derivatives of the order of 100, and rounding 1e-16/h, 1e-16/h^2.
  const double h = 1e-5;
  for (int i = 0; i < 7; ++i)
    EXPECT_NEAR(G[i], (value(u + h * Vector::Unit(i)) - value(u - h * Vector::Unit(i))) / (2. * h), 1e-7) << i;
  EXPECT_NEAR(now.rate, G.dot(v), 1e-13);

  const double k      = 1e-3;
  const auto   moving = [&](double t) { return value(u + t * v + 0.5 * t * t * a); };
  const auto   second = [&](double k) { return (moving(k) - 2. * moving(0.) + moving(-k)) / (k * k); };
  // Richardson's extrapolation of the quotient: h^4 is left.
  EXPECT_NEAR(G.dot(a) + now.bias, (4. * second(0.5 * k) - second(k)) / 3., 1e-6);

  Eigen::Matrix<double, 7, 7> curvature = Eigen::Matrix<double, 7, 7>::Zero();
  measure.add_curvature(u.data(), 1., curvature.data());
  EXPECT_NEAR(v.dot(curvature * v), now.bias, 1e-12 * std::abs(now.bias));
  for (int j = 0; j < 7; ++j)
  {
    Vector plus, minus;
    measure.evaluate(Vector(u + h * Vector::Unit(j)).data(), zero.data(), plus.data());
    measure.evaluate(Vector(u - h * Vector::Unit(j)).data(), zero.data(), minus.data());
    EXPECT_LT((curvature.col(j) - (plus - minus) / (2. * h)).norm(), 1e-6) << j;
  }
}

// --- motions over time

TEST(ProfileMotion, IsTheIntegralOfItsSpeed)
{
  using Ramp = Profile::Ramp;
  const Profile       speed("speed", 1., {Ramp{0.5, 3., 4., 20.}, Ramp{3., -1., 2., Profile::unlimited}});
  const ProfileMotion motion(speed);
  std::vector<double> state(motion.n_history());
  double *const       history = state.data();
  motion.start(0.2, history);
  EXPECT_EQ(motion.at(0.2, history).value, 0.);
  double last = 0., t_last = 0.2;
  while (motion.n_guards(history) > 0)
  {
    double g;
    motion.guard_values(0., history, &g);
    const double corner = -g, middle = 0.5 * (t_last + corner);
    // Simpson's rule is exact for the pieces of second degree.
    const auto rate = [&](double t) { return motion.at(t, history).rate; };
    last += (corner - t_last) / 6. * (rate(t_last) + 4. * rate(middle) + rate(corner));
    EXPECT_NEAR(motion.at(corner, history).value, last, 1e-12);
    const double h = 1e-5;
    EXPECT_NEAR(motion.at(middle, history).acceleration, (rate(middle + h) - rate(middle - h)) / (2. * h), 1e-8);
    motion.transition(0, corner, history);
    EXPECT_NEAR(motion.at(corner, history).value, last, 1e-12); // no jump at the corner
    t_last = corner;
  }
  EXPECT_EQ(motion.at(10., history).rate, -1.);
  expect_refusal([] { ProfileMotion(Profile("speed", 0., {Ramp{1., 2.}})); }, "jump of the speed");
}

} // namespace
} // namespace gestell::tests
