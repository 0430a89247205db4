// Derivatives of forces whose directions turn with the motion, at rest and in motion, against difference quotients.

#include "mechanism/elements/follower_load.h"
#include "mechanism/elements/formula_force.h"
#include "mechanism/elements/spring_damper.h"
#include "mechanism/facets.h"
#include "mechanism/transmitted_element.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace mechanism;
using Eigen::MatrixXd, Eigen::VectorXd;

const std::vector<Placement::LinearMeasure> plane = {{Vector3d::UnitX(), Vector3d::Zero()},
                                                     {Vector3d::UnitZ(), Vector3d::Zero()}};

Placement on_plate(const Vector3d &point)
{
  return {point, Vector3d(0.2, 0., 0.1), plane, Vector3d::UnitY()};
}

VectorXd scattered(int n, double first)
{
  VectorXd x(n);
  for (int i = 0; i < n; ++i)
    x[i] = 0.6 * std::sin(first + 1.7 * i * i);
  return x;
}

/// dp/du as told, directions held and as they turn, is that of the force.
void expect_derivative(const ForceLaw &element)
{
  constexpr double    h = 1e-5;
  const int           n = element.n_measures();
  std::vector<double> history(std::size_t(n_history(element)) + 1);
  const VectorXd      u = scattered(n, 0.3), a = VectorXd::Zero(n);
  for (const double speed : {0., 5.})
  {
    const VectorXd v      = speed * scattered(n, 1.1);
    const auto     motion = [&](const VectorXd &at) { return LocalMotion{0.1, at.data(), v.data(), a.data()}; };
    VectorXd       p(n), below(n), above(n);
    MatrixXd       dp_du(n, n), dp_dv(n, n), K(n, n);
    element.derivatives(motion(u), history.data(), p.data(), dp_du.data(), dp_dv.data());
    geometric(element, motion(u), history.data(), K.data());
    const MatrixXd whole = dp_du - K;
    for (int j = 0; j < n; ++j)
    {
      const VectorXd right = u + h * VectorXd::Unit(n, j), left = u - h * VectorXd::Unit(n, j);
      element.force(motion(right), history.data(), above.data());
      element.force(motion(left), history.data(), below.data());
      // Central quotients: h^2/6 of the third derivative, and epsilon/h of rounding.
      EXPECT_LT((whole.col(j) - (above - below) / (2. * h)).cwiseAbs().maxCoeff(), 1e-8 * whole.cwiseAbs().maxCoeff())
          << j << " at " << speed;
    }
  }
}

TEST(TurningForces, OfASpringBetweenTwoPointsAreReported)
{
  RelativeMeasure distance;
  distance.form = RelativeMeasure::Form::distance;
  const CombinedMeasure between(PlacedMeasure{on_plate({1., 0., 0.5}), on_plate({-0.7, 0., 0.9}), distance});
  expect_derivative(
      TransmittedElement(between, std::make_shared<SpringDamper>(SpringDamper::Parameters{300., 40., 0., 0.}), 0.8));
}

// A thrust that falls with the speed along itself: 5 N - 3 N s/m v.
TEST(TurningForces, OfAFollowerLoadAreReported)
{
  const auto thrust = std::make_shared<FormulaForce>(FormulaForce::Parameters{5. - 3. * Formula::variable(2)});
  expect_derivative(FollowerLoad(on_plate({1., 0., 0.5}), Vector3d(0.6, 0., 0.8), thrust));
}

} // namespace
} // namespace gestell::tests
