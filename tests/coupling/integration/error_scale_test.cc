#include "coupling/integration/system/error_scale.h"

#include "tests/support/modal_system.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace coupling;
using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

const Vector none;

ErrorScale::Motion motion(const Vector &q, const Vector &v)
{
  return {q, v, none, none};
}

/// Error of a step from rest to q, v that took h.
double error(const SecondOrderSystem &system, const Vector &q, const Vector &v, const Vector &e_q, const Vector &e_v,
             double h)
{
  ErrorScale   scale(system, system.linear().spectrum(), 1e-6);
  const Vector rest = Vector::Zero(q.size());
  scale.begin(motion(rest, rest));
  EXPECT_TRUE(scale.consider(h, h, motion(rest, rest), motion(q, v), none));
  return scale.error(motion(e_q, e_v));
}

// A change of coordinates q = D z leaves energies as they are: radians or milliradians, kilograms or tons.
TEST(ErrorScale, DoesNotDependOnTheUnitsOfCoordinates)
{
  Matrix M(2, 2), C(2, 2);
  M << 3., 0., 0., 0.02;
  C << 4e4, -50., -50., 70.;
  const Vector          D = Eigen::Vector2d(1e-3, 50.);
  const Eigen::Vector2d q(2e-3, 0.1), v(0.5, -3.), e_q(1e-8, 3e-7), e_v(-2e-6, 4e-5);
  const ModalSystem     metres(M, 1e-3 * C, C);
  const Matrix          M_z = D.asDiagonal() * M * D.asDiagonal(), C_z = D.asDiagonal() * C * D.asDiagonal();
  const ModalSystem     other(M_z, 1e-3 * C_z, C_z);
  const auto            in_z     = [&](const Vector &x) -> Vector { return x.cwiseQuotient(D); };
  const double          expected = error(metres, q, v, e_q, e_v, 1e-3);
  EXPECT_GT(expected, 0.);
  EXPECT_NEAR(error(other, in_z(q), in_z(v), in_z(e_q), in_z(e_v), 1e-3), expected, 1e-9 * expected);
}

// What coordinate 0 does is worth nothing to coordinate 1 if no matrix couples them, and everything if one does.
TEST(ErrorScale, LargeMotionsLoosenNothingThatTheyAreNotCoupledTo)
{
  const auto error_of_second = [](double coupling, double first)
  {
    Matrix C(2, 2);
    C << 900., coupling, coupling, 900.;
    const ModalSystem system(Matrix::Identity(2, 2), Matrix::Zero(2, 2), C);
    return error(system, Eigen::Vector2d(first, 1e-3), Eigen::Vector2d(30. * first, 0.03), Eigen::Vector2d(0., 1e-8),
                 Eigen::Vector2d(0., 0.), 1e-3);
  };
  EXPECT_DOUBLE_EQ(error_of_second(0., 1e-3), error_of_second(0., 1.));
  EXPECT_NEAR(error_of_second(1., 1e-3) / error_of_second(1., 1.), 707., 1.);
}

// A shaft that turns freely at 100 rad/s, coupled to a vibration of 50 rad/s: after hours the scale is still what the
// shaft's speed changes by, over the time of the vibration, and not the angle.
TEST(ErrorScale, FreeRotationHasNoLargestExcursion)
{
  Matrix C(2, 2);
  C << 1250., -1250., -1250., 1250.; // two inertias on a spring: rigid rotation and 50 rad/s
  const ModalSystem system(Matrix::Identity(2, 2), Matrix::Zero(2, 2), C);
  ErrorScale        scale(system, system.linear().spectrum(), 1e-4);
  const auto        at = [](double t, double &twist, double &rate)
  {
    twist = 1e-2 * std::sin(50. * t);
    rate  = 0.5 * std::cos(50. * t);
    return 100. * t;
  };
  double       twist, rate;
  const double angle = at(0., twist, rate);
  scale.begin(motion(Eigen::Vector2d(angle + twist, angle - twist), Eigen::Vector2d(100. + rate, 100. - rate)));
  const double h     = 1e-3;
  double       first = 0., last = 0.;
  for (const double t : {1., 1.02, 1.04, 1000., 1000.02, 1000.04, 1000.06})
  {
    Vector from(2), from_v(2), to(2), to_v(2);
    double angle_at = at(t, twist, rate);
    from << angle_at + twist, angle_at - twist;
    from_v << 100. + rate, 100. - rate;
    angle_at = at(t + h, twist, rate);
    to << angle_at + twist, angle_at - twist;
    to_v << 100. + rate, 100. - rate;
    ASSERT_TRUE(scale.consider(t + h, h, motion(from, from_v), motion(to, to_v), none));
    scale.accept();
    last = scale.error(motion(Eigen::Vector2d(1e-4, -1e-4), Eigen::Vector2d(0., 0.)));
    if (t == 1.04)
      first = last;
  }
  // An error of 1 % of the vibration, for a hundredth or so of its way in this step: of the order of one; relative to
  // 1e5 rad it would be 1e-7.
  EXPECT_GT(last, 0.01);
  EXPECT_NEAR(last / first, 1., 0.5);
}

// A refused step tells what will be: until its end, and no longer.
TEST(ErrorScale, AMotionFromRestIsMeasuredByWhereARefusedStepWouldHaveLed)
{
  const ModalSystem system(Matrix::Identity(1, 1), Matrix::Zero(1, 1), Matrix::Identity(1, 1));
  ErrorScale        scale(system, system.linear().spectrum(), 1e-6);
  const Vector      rest = Vector::Zero(1), e = Vector::Constant(1, 1e-6);
  const auto        cube = [](double t) -> std::pair<Vector, Vector> {
    return {Vector::Constant(1, t * t * t), Vector::Constant(1, 3. * t * t)};
  };
  const auto measured = [&](double from, double to)
  {
    const auto [q_0, v_0] = cube(from);
    const auto [q_1, v_1] = cube(to);
    EXPECT_TRUE(scale.consider(to, to - from, motion(q_0, v_0), motion(q_1, v_1), none));
    return scale.error(motion(e, rest));
  };
  scale.begin(motion(rest, rest));
  const double large = measured(0., 0.1), alone = measured(0., 0.01);
  EXPECT_NEAR(alone / large, 1000., 1.); // relative to itself alone
  measured(0., 0.1);
  scale.refuse();
  EXPECT_LT(measured(0., 0.01), 20. * large); // E of the step refused; chi is less
  scale.accept();
  measured(0.05, 0.06);
  scale.accept();
  // beyond 0.1 the motion has gone that way itself, and the refused step counts no more
  const double after = measured(0.1, 0.11);
  ErrorScale   other(system, system.linear().spectrum(), 1e-6);
  other.begin(motion(rest, rest));
  const auto [q_0, v_0] = cube(0.1);
  const auto [q_1, v_1] = cube(0.11);
  ASSERT_TRUE(other.consider(0.11, 0.01, motion(q_0, v_0), motion(q_1, v_1), none));
  EXPECT_DOUBLE_EQ(other.error(motion(e, rest)), after);
}

// The mass at the far end of a chain starts like t^4 and later, however strongly its measure is looked at by itself.
TEST(ErrorScale, AMeasureDoesNotCountForLessThanAMillionthOfItsGroup)
{
  Matrix C(2, 2);
  C << 2., -1., -1., 1.;
  ModalSystem system(Matrix::Identity(2, 2), Matrix::Zero(2, 2), C);
  system.set_law(Eigen::Vector2d(0., 1.),
                 [](double, double, double &p, double &dp_du, double &dp_dv) { p = dp_du = dp_dv = 0.; });
  const Vector rest = Vector::Zero(2), still = Vector::Zero(1);
  const auto   measured = [&](double far)
  {
    ErrorScale   scale(system, system.linear().spectrum(), 1e-6);
    const Vector q = Eigen::Vector2d(1e-3, far), v = 20. * q, u = q.tail(1), rate = v.tail(1),
                 e = Vector::Constant(1, 1e-12);
    scale.begin({rest, rest, still, still});
    EXPECT_TRUE(scale.consider(0.1, 0.1, {rest, rest, still, still}, {q, v, u, rate}, still));
    return scale.error({rest, rest, e, still});
  };
  EXPECT_NEAR(measured(1e-15), measured(1e-13), 1e-3 * measured(1e-13));
  EXPECT_GT(measured(1e-15), 100. * measured(1e-3));
  EXPECT_NEAR(measured(1e-15), 1e-12 / (1e-6 * 1e-3), 1e-5); // 1e-6 of 1 mm; chi is one
}

/// A rotor J with the law  T z' + z = k (w_r - phi') + z  of a drive: z has no mass.
class ControlledRotor : public SmallSystem
{
public:
  ControlledRotor(double J, double T, double gain)
      : SmallSystem(Eigen::Vector2d(J, 0.).asDiagonal(), Eigen::Vector2d(0., T).asDiagonal(),
                    Eigen::Vector2d(0., 1.).asDiagonal()),
        dp_du(Matrix::Zero(2, 2)), dp_dv(dp_du)
  {
    W           = Matrix(Matrix::Identity(2, 2)).sparseView();
    dp_dv(0, 0) = dp_dv(1, 0) = -gain;
    dp_du(0, 1) = dp_du(1, 1) = 1.;
  }
  const std::vector<int> &virtual_coordinates() const override { return z_; }

  Matrix dp_du, dp_dv;

private:
  std::vector<int> z_{1};
};

/// Error 1e-6 k of z after a step in which the rotor left the speed of 100 rad/s by `way`, and z nothing.
double error_of_torque(double J, double T, double gain, double way)
{
  ControlledRotor system(J, T, gain);
  ErrorScale      scale(system, system.linear().spectrum(), 1e-6);
  const double    h = 1e-3, speed = 100.;
  const Vector    q = Vector::Zero(2), v = Eigen::Vector2d(speed, 0.), to_q = Eigen::Vector2d(speed * h, 0.),
               to_v = Eigen::Vector2d(speed + way, 0.), e = Eigen::Vector2d(0., 1e-6 * gain), none_moved = q;
  scale.begin({q, v, q, v});
  scale.laws(system.dp_du, system.dp_dv);
  EXPECT_TRUE(scale.consider(h, h, {q, v, q, v}, {to_q, to_v, to_q, to_v}, none_moved));
  return scale.error({q, q, e, q});
}

// A drive holds its speed: nothing moves but what rounding makes of k (w_r - phi'), and no torque is told more exactly.
TEST(ErrorScale, VirtualCoordinatesAreMeasuredByWhatTheirLawFollows)
{
  const double at_rest = error_of_torque(2., 0.1, 40., 0.), disturbed = error_of_torque(2., 0.1, 40., 1.);
  EXPECT_TRUE(std::isfinite(at_rest));
  // rounding / tolerance of k w: 8 eps / 1e-6 of 40 * 100 against 4e-5
  EXPECT_NEAR(at_rest, 4e-5 / (8. * 2.22e-16 / 1e-6 * 4000.), 0.01 * at_rest);
  EXPECT_LT(disturbed, 0.1 * at_rest);
}

// Torques in N m or kN m: the unit of z takes the gain with it.
TEST(ErrorScale, VirtualCoordinatesDoNotDependOnUnits)
{
  for (const double way : {0., 1.})
    EXPECT_NEAR(error_of_torque(2e-3, 0.1, 40e-3, way), error_of_torque(2., 0.1, 40., way),
                1e-9 * error_of_torque(2., 0.1, 40., way));
}

// A pulse that is to come moves 1 mm: what is a billionth of that today need not be exact against itself; a bystander
// changes nothing.
TEST(ErrorScale, MotionsAreMeasuredByThoseThatLoadsToComeWouldBring)
{
  const auto measured = [](double expected, int bystanders)
  {
    const int         n = 1 + bystanders;
    const ModalSystem system(Matrix::Identity(n, n), Matrix::Zero(n, n), Matrix(900. * Matrix::Identity(n, n)));
    ErrorScale        scale(system, system.linear().spectrum(), 1e-6);
    const Vector      rest = Vector::Zero(n);
    Vector            q = rest, v = rest, e = rest;
    q[0] = 1e-15, v[0] = 1e-12, e[0] = 1e-16;
    scale.begin(motion(rest, rest));
    scale.expect(expected, 30. * expected);
    EXPECT_TRUE(scale.consider(1e-3, 1e-3, motion(rest, rest), motion(q, v), none));
    return scale.error(motion(e, rest));
  };
  EXPECT_GT(measured(0., 0), 0.05);
  EXPECT_NEAR(measured(1e-3, 0), 1e-16 / (1e-6 * 1e-3) / (30. * 1e-3), 1e-2 * measured(1e-3, 0)); // chi = 30/s 1 ms
  EXPECT_DOUBLE_EQ(measured(1e-3, 3), measured(1e-3, 0));
}

TEST(ErrorScale, ReportsMotionsThatAreNotFinite)
{
  const ModalSystem system(Matrix::Identity(2, 2), Matrix::Zero(2, 2), Matrix::Identity(2, 2));
  ErrorScale        scale(system, system.linear().spectrum(), 1e-6);
  const Vector      rest = Vector::Zero(2), wild = Eigen::Vector2d(0., std::nan(""));
  scale.begin(motion(rest, rest));
  EXPECT_FALSE(scale.consider(1., 1., motion(rest, rest), motion(rest, wild), none));
  EXPECT_FALSE(scale.consider(1., 1., motion(rest, rest), motion(wild, rest), none));
}

TEST(ErrorScale, NamesTheCoordinateOrTheForceOfTheLargestError)
{
  ModalSystem  system = duffing(1., 1.);
  ErrorScale   scale(system, system.linear().spectrum(), 1e-6);
  const Vector rest = Vector::Zero(1), one = Vector::Ones(1);
  scale.begin({rest, rest, rest, rest});
  ASSERT_TRUE(scale.consider(0.1, 0.1, {rest, rest, rest, rest}, {one, one, one, one}, rest));
  EXPECT_EQ(scale.worst({one, rest, rest, rest}), "q0");
  EXPECT_EQ(scale.worst({rest, rest, one, rest}), "the force on q0");
  EXPECT_GT(scale.error_of_measures(rest, one), 0.);
}

} // namespace
} // namespace gestell::tests
