// Forces of a compliant joint against difference quotients, and the work they do.

#include "mechanism/facets.h"
#include "mechanism/joints/compliant_joint.h"
#include "tests/support/test.h"

#include <Eigen/Geometry>

namespace gestell::tests
{
namespace
{

using Eigen::MatrixXd, Eigen::VectorXd;
using mechanism::CompliantJoint;
using mechanism::IdealJoint;
using mechanism::Placement;
using mechanism::RelativeMeasure;
using mechanism::Vector3d;

const Vector3d point(0.4, -0.3, 0.7), axis = Vector3d(1., 2., -2.) / 3.;

/// On the ground, in a plane, carried by a frame and turning on it, free in space.
std::vector<Placement> placements()
{
  const std::vector<Placement::LinearMeasure> plane = {{Vector3d::UnitX(), Vector3d::Zero()},
                                                       {Vector3d::UnitZ(), Vector3d::Zero()}};
  const std::vector<Placement::LinearMeasure> frame = {{Vector3d::UnitY(), Vector3d(0.2, 0., 0.1)},
                                                       {Vector3d::Zero(), Vector3d(0., 0.3, 0.)}};
  return {Placement(point), Placement(point, Vector3d(0.1, 0., -0.2), plane, Vector3d::UnitY()),
          Placement(point, Vector3d(0., 0.5, 0.), frame, axis), Placement::free(point, Vector3d(0.2, 0.1, 0.3))};
}

/// Two displacements, fixed in space and carried, and two rotations.
CompliantJoint joint(const Placement &first, const Placement &second)
{
  using Form = RelativeMeasure::Form;
  std::vector<CompliantJoint::Equation> equations(4);
  for (auto &equation : equations)
    equation = {{}, 3e4, 50.};
  equations[0].demand.measure.a       = Vector3d::UnitX();
  equations[1].demand.measure.a       = axis;
  equations[1].demand.measure.carrier = RelativeMeasure::Carrier::first;
  equations[1].demand.offset          = 0.01;
  for (const int i : {2, 3})
  {
    equations[i].demand.unit         = "N m";
    equations[i].demand.measure.form = Form::square;
    equations[i].demand.measure.a    = i == 2 ? axis.unitOrthogonal() : axis;
    equations[i].demand.measure.b    = axis.cross(axis.unitOrthogonal());
  }
  return {first, second, equations};
}

VectorXd numbers(int n, double first, double size)
{
  VectorXd x(n);
  for (int i = 0; i < n; ++i)
    x[i] = size * std::sin(first + 1.7 * i * i);
  return x;
}

struct Motion
{
  explicit Motion(int n) : u(numbers(n, 0.3, 0.2)), v(numbers(n, 1.1, 0.4)), a(VectorXd::Zero(n)) {}
  VectorXd u, v, a;

  mechanism::LocalMotion local() const { return {0., u.data(), v.data(), a.data()}; }
};

VectorXd force(const CompliantJoint &joint, const VectorXd &u, const VectorXd &v)
{
  VectorXd p(joint.n_measures());
  joint.force({0., u.data(), v.data(), u.data()}, nullptr, p.data());
  return p;
}

template <class Check>
void for_all_pairs(const Check &check)
{
  const auto all = placements();
  for (const Placement &first : all)
    for (const Placement &second : all)
      if (first.n_measures() + second.n_measures() > 0)
        check(joint(first, second), Motion(first.n_measures() + second.n_measures()));
}

// At rest p follows from an energy; in motion a rate turns with the axis it is taken along, too.  p depends on v
// linearly.
TEST(CompliantJoint, TangentAndGeometricStiffnessAreTheDerivativeOfTheForce)
{
  constexpr double h = 1e-5;
  for_all_pairs(
      [&](const CompliantJoint &joint, Motion motion)
      {
        const int n = joint.n_measures();
        VectorXd  p(n);
        MatrixXd  dp(n, n), by_rates(n, n), geometric(n, n), dp_du(n, n), dp_dv(n, n), K(n, n), D(n, n);
        for (const bool moves : {true, false})
        {
          if (!moves)
            motion.v.setZero();
          joint.tangent(motion.local(), nullptr, {1., 0., 0.}, p.data(), dp.data());
          joint.tangent(motion.local(), nullptr, {0., 1., 0.}, p.data(), by_rates.data());
          mechanism::geometric(joint, motion.local(), nullptr, geometric.data());
          joint.derivatives(motion.local(), nullptr, p.data(), dp_du.data(), dp_dv.data());
          joint.engaged(motion.u.data(), K.data(), D.data());
          const MatrixXd whole = dp - geometric;
          const double   size  = whole.cwiseAbs().maxCoeff();
          for (int j = 0; j < n; ++j)
          {
            const VectorXd step   = h * VectorXd::Unit(n, j);
            const VectorXd change = force(joint, motion.u + step, motion.v) - force(joint, motion.u - step, motion.v);
            // Central quotients: h^2/6 of the third derivative, and epsilon/h of rounding.
            EXPECT_LT((whole.col(j) - change / (2. * h)).cwiseAbs().maxCoeff(), 1e-8 * size) << j << moves;
            EXPECT_LT((by_rates.col(j) - (force(joint, motion.u, motion.v + VectorXd::Unit(n, j)) - p)).norm(),
                      1e-12 * (by_rates.norm() + p.norm()));
          }
          EXPECT_EQ((dp - dp_du).cwiseAbs().maxCoeff(), 0.);
        }
        const MatrixXd whole = dp - geometric; // of rest
        EXPECT_LT((whole - whole.transpose()).cwiseAbs().maxCoeff(), 1e-13 * whole.cwiseAbs().maxCoeff());
        EXPECT_EQ((K + dp_du).cwiseAbs().maxCoeff(), 0.);
        EXPECT_EQ((D + dp_dv).cwiseAbs().maxCoeff(), 0.);
      });
}

/// Rates of a body with its centre of mass c that turns with w about y about the origin.
VectorXd turning(const Vector3d &c, const VectorXd &u, double w)
{
  return Vector3d(w * (c.z() + u[1]), -w * (c.x() + u[0]), w);
}

// Forces that depend on what the first body sees of the second, and balance each other: turning both alike changes no
// force, and no such motion has any power.
TEST(CompliantJoint, OnAxesOfTheFirstBodyBrakesNothingThatTurnsAsAWhole)
{
  using Carrier                                       = RelativeMeasure::Carrier;
  const std::vector<Placement::LinearMeasure> plane   = {{Vector3d::UnitX(), Vector3d::Zero()},
                                                         {Vector3d::UnitZ(), Vector3d::Zero()}};
  const Vector3d                              c_1     = Vector3d(0.1, 0., -0.2), c_2(0.9, 0., 0.3);
  const auto                                  between = [&](Carrier carrier)
  {
    std::vector<CompliantJoint::Equation> equations(2);
    for (const int i : {0, 1})
    {
      equations[i]                        = {{}, 3e4, 50.};
      equations[i].demand.measure.a       = i == 0 ? Vector3d::UnitX() : Vector3d::UnitZ();
      equations[i].demand.measure.carrier = carrier;
    }
    return CompliantJoint({point, c_1, plane, Vector3d::UnitY()}, {point, c_2, plane, Vector3d::UnitY()}, equations);
  };
  const Motion motion(6);
  VectorXd     whole(6);
  whole << turning(c_1, motion.u.head(3), 7.), turning(c_2, motion.u.tail(3), 7.);
  const CompliantJoint carried = between(Carrier::first), fixed = between(Carrier::space);
  const VectorXd       p = force(carried, motion.u, motion.v);
  EXPECT_LT((force(carried, motion.u, motion.v + whole) - p).norm(), 1e-13 * p.norm());
  EXPECT_LT(std::abs(p.dot(whole)), 1e-13 * p.norm() * whole.norm());
  EXPECT_GT((force(fixed, motion.u, motion.v + whole) - p).norm(), 1e-3 * p.norm()); // those of axes fixed in space do
  for (const int x : {0, 1})
    EXPECT_NEAR(p[x] + p[3 + x], 0., 1e-13 * p.norm());
}

// p . u' = -(1/2 k s^2)' - d s'^2, and lambda = -k s - d s' is what the signals tell.
TEST(CompliantJoint, StoresWhatItsSpringsTakeAndLosesTheRest)
{
  constexpr double h = 1e-5, d = 50.;
  for_all_pairs(
      [&](const CompliantJoint &joint, const Motion &motion)
      {
        const auto energy = [&](double t)
        {
          Motion there = motion;
          there.u += t * motion.v;
          return joint.stored_energy(there.local(), nullptr);
        };
        double   lost = 0.;
        VectorXd G(joint.n_measures()), p = force(joint, motion.u, motion.v), of_lambda = 0. * p;
        double   squares = 0.;
        for (int i = 0; i < joint.n_equations(); ++i)
        {
          const auto   opening = joint.opening(i, motion.u.data(), motion.v.data(), G.data());
          const double lambda  = joint.quantity(i, motion.local(), nullptr);
          EXPECT_NEAR(lambda, -3e4 * opening.s - d * opening.rate, 1e-9 * std::abs(lambda));
          lost += d * opening.rate * opening.rate;
          of_lambda += lambda * G;
          squares += i < 2 ? lambda * lambda : 0.;
        }
        EXPECT_LT((p - of_lambda).norm(), 1e-12 * p.norm());
        EXPECT_NEAR(joint.quantity(joint.n_equations(), motion.local(), nullptr), std::sqrt(squares), 1e-9 * p.norm());
        const double stored = (energy(h) - energy(-h)) / (2. * h);
        EXPECT_NEAR(p.dot(motion.v), -stored - lost, 1e-8 * (std::abs(stored) + lost));
      });
}

TEST(CompliantJoint, RefusesWhatMakesNoJoint)
{
  const Placement ground{Vector3d::Zero()};
  const auto      refused = [&](const std::vector<CompliantJoint::Equation> &equations)
  { EXPECT_THROW(CompliantJoint(ground, ground, equations), std::invalid_argument); };
  refused({});
  refused(std::vector<CompliantJoint::Equation>(7));
  refused({{{}, -1., 0.}});
  refused({{{}, 1., -1.}});
  CompliantJoint::Equation driven{{}, 1., 0.};
  driven.demand.driven = true;
  refused({driven});
}

} // namespace
} // namespace gestell::tests
