#include "coupling/integration/bdf/bdf.h"
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

Vector vector(double x, double y, double z)
{
  return (Vector(3) << x, y, z).finished();
}

/// Three coupled masses with damping and a load.
class Chain : public SmallSystem
{
public:
  Chain() : SmallSystem(matrix(3., 0.2), matrix(5., -1.), matrix(400., -120.))
  {
    loads().add_constant(0, 3.);
    loads().add_harmonic(2, 7., 20., -5.);
  }

  /// M^-1 (f - B v - C q), without forces of elements
  Vector free_acceleration(double t, const Vector &q, const Vector &v) const
  {
    Vector f(3);
    excitation().at(t, f);
    return M.partialPivLu().solve(f - B * v - C * q);
  }

private:
  static Matrix matrix(double own, double coupled)
  {
    Matrix a = Matrix::Constant(3, 3, coupled);
    a.diagonal() << own, 1.3 * own, 0.8 * own;
    return a;
  }
};

/// A mass m on the measure, as a force: p = -m u''.
class ChainWithAddedMass : public Chain
{
public:
  explicit ChainWithAddedMass(double m) : mass(m) { W = Matrix(vector(1., -1., 2.)).sparseView(); }
  void tangent(const LocalState &state, double, double, double w_a, Vector &p, Matrix &dp) const override
  {
    p[0]     = -mass * state.a[0];
    dp(0, 0) = -w_a * mass;
  }
  double mass;
};

/// Two measures; the second sticks: its rate stays what it is.  A spring acts on the first.
class ChainThatSticks : public Chain
{
public:
  ChainThatSticks()
  {
    Matrix w(3, 2);
    w << 1., 0., -1., 0.5, 0., 1.;
    W = w.sparseView();
  }
  const std::vector<HeldMeasure> &held() const override { return held_measures; }
  void                            force(const LocalState &state, Vector &p) const override { p[0] = -50. * state.u[0]; }
  void tangent(const LocalState &state, double w_u, double, double, Vector &p, Matrix &dp) const override
  {
    dp.setZero();
    p[0]     = -50. * state.u[0];
    dp(0, 0) = -50. * w_u;
  }
  std::vector<HeldMeasure> held_measures{{1, 0.4}};
};

/// Motion of the measures of q, v at t, as ConsistentStart asks for it.
LocalState measures(const SecondOrderSystem &system, double t, const Vector &q, const Vector &v)
{
  LocalState local;
  local.resize(system);
  local.t = t;
  local.u = system.forces().directions().transpose() * q;
  local.v = system.forces().directions().transpose() * v;
  return local;
}

const Vector q0 = vector(0.1, -0.2, 0.05), v0 = vector(1., 0.3, -0.4);

/// Accelerations and forces of the start from q0, v0 at t.
std::pair<Vector, LocalState> started(const SecondOrderSystem &system, double t)
{
  ConsistentStart start(system, "test");
  LocalState      local = measures(system, t, q0, v0);
  Vector          a(3);
  IntegrationWork work;
  start.solve(q0, v0, a, local, work);
  return {a, local};
}

TEST(ConsistentStart, WithoutElementsIsTheEquationOfMotion)
{
  const Chain system;
  const auto [a, local] = started(system, 0.3);
  EXPECT_LT((a - system.free_acceleration(0.3, q0, v0)).norm(), 1e-13 * a.norm());
}

TEST(ConsistentStart, ForcesProportionalToTheAccelerationAreMass)
{
  const ChainWithAddedMass system(2.5);
  const auto [a, local] = started(system, 0.3);
  const Vector w        = Matrix(system.W);
  const Matrix with     = system.M + 2.5 * w * w.transpose();
  const Vector expected = with.partialPivLu().solve(system.M * system.free_acceleration(0.3, q0, v0));
  EXPECT_LT((a - expected).norm(), 1e-12 * expected.norm());
  EXPECT_NEAR(local.a[0], w.dot(expected), 1e-12 * expected.norm());
  EXPECT_NEAR(local.p[0], -2.5 * w.dot(expected), 1e-11 * expected.norm());
}

TEST(ConsistentStart, AMeasureThatSticksIsNotAcceleratedAndItsForceKeepsItSo)
{
  const ChainThatSticks system;
  const auto [a, local] = started(system, 0.3);

  // [M  -w1; w1^T 0] (a, p1) = (f - B v - C q + w0 p0, 0)
  const Matrix W = system.W;
  Matrix       saddle(4, 4);
  saddle << system.M, -W.col(1), W.col(1).transpose(), Matrix::Zero(1, 1);
  Vector right(4);
  right << system.M * system.free_acceleration(0.3, q0, v0) + W.col(0) * (-50. * W.col(0).dot(q0)), 0.;
  const Vector expected = saddle.partialPivLu().solve(right);
  EXPECT_LT((a - expected.head(3)).norm(), 1e-12 * a.norm());
  EXPECT_NEAR(local.p[1], expected[3], 1e-12 * std::abs(expected[3]));
  EXPECT_EQ(local.a[1], 0.);
  EXPECT_NEAR(local.p[0], -50. * W.col(0).dot(q0), 1e-13);
}

TEST(ConsistentStart, BdfBeginsWithTheForceOfWhatSticks)
{
  const ChainThatSticks system;
  const auto [a, local] = started(system, 0.);
  Bdf bdf(system, {2, 1e-3});
  bdf.begin(0., q0, v0);
  EXPECT_DOUBLE_EQ(bdf.local().p[1], local.p[1]);
}

TEST(ConsistentStart, BdfNeedsNoMassEvenWhereSomethingSticks)
{
  ChainThatSticks system;
  system.M.row(2).setZero();
  system.M.col(2).setZero();
  Bdf bdf(system, {2, 1e-3});
  bdf.begin(0., q0, v0);
  bdf.advance();
  EXPECT_NEAR(bdf.local().v[1], 0.4, 1e-12);
}

TEST(ConsistentStart, NamesACoordinateWithoutMassAndTheWayOut)
{
  Chain system;
  system.M.row(1).setZero();
  system.M.col(1).setZero();
  const std::string message = refusal(
      [&]
      {
        Newmark::Options options;
        options.step = 1e-3;
        Newmark(system, options);
      });
  EXPECT_NE(message.find("Newmark"), std::string::npos) << message;
  EXPECT_NE(message.find("q1 has no mass"), std::string::npos) << message;
  EXPECT_NE(message.find("bdf"), std::string::npos) << message;
}

} // namespace
} // namespace gestell::tests
