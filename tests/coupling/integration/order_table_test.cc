#include "tests/support/reference_table.h"
#include "tests/support/small_system.h"
#include "tests/support/step_map.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace coupling;
using Vector      = Eigen::VectorXd;
using Matrix      = Eigen::MatrixXd;
using Real        = long double; // of exact solutions, to all digits of the table
using LongComplex = std::complex<Real>;
using Complex2    = Eigen::Matrix<LongComplex, 2, 1>;
using Complex4    = Eigen::Matrix<LongComplex, 4, 1>;

/// Case a of the reference: two coupled masses with non-proportional damping, F_j cos(Omega_j t) on coordinate j.
class LinearPair
{
public:
  LinearPair() : system_(matrix(2., 0.3, 1.), matrix(4., -1., 2.5), matrix(6000., -2000., 2500.))
  {
    system_.loads().add_harmonic(0, Omega[0], F[0], 0.);
    system_.loads().add_harmonic(1, Omega[1], F[1], 0.);

    // Free part: q = Re sum X_j c_j e^(s_j t) of the first-order form; c from the start, less what the load carries.
    using Square  = Eigen::Matrix<Real, 4, 4>;
    using Small   = Eigen::Matrix<Real, 2, 2>;
    const Small M = system_.M.cast<Real>(), B = system_.B.cast<Real>(), C = system_.C.cast<Real>();
    Square      A = Square::Zero();
    A.topRightCorner(2, 2).setIdentity();
    A.bottomLeftCorner(2, 2)  = -M.inverse() * C;
    A.bottomRightCorner(2, 2) = -M.inverse() * B;
    const Eigen::EigenSolver<Square> solver(A);
    s_ = solver.eigenvalues();
    X_ = solver.eigenvectors();
    for (int j = 0; j < 2; ++j)
    {
      const Eigen::Matrix<LongComplex, 2, 2> Z = C.cast<LongComplex>() +
                                                 LongComplex(0., Omega[j]) * B.cast<LongComplex>() -
                                                 LongComplex(Omega[j] * Omega[j]) * M.cast<LongComplex>();
      forced_[j] = Z.inverse() * (LongComplex(F[j]) * Complex2::Unit(j));
    }
    c_.setZero();
    Complex4 start;
    start << q0.cast<LongComplex>(), v0.cast<LongComplex>();
    c_ = X_.partialPivLu().solve(start - state(0.));
  }

  /// (q, q') at t.
  Complex4 state(double t) const
  {
    Complex4 y = X_ * c_.cwiseProduct((s_ * LongComplex(t)).array().exp().matrix());
    for (int j = 0; j < 2; ++j)
    {
      const Complex2 q = forced_[j] * std::exp(LongComplex(0., Omega[j] * Real(t)));
      y.head(2) += q.real().cast<LongComplex>();
      y.tail(2) += (LongComplex(0., Omega[j]) * q).real().cast<LongComplex>();
    }
    return y;
  }
  Vector             q(double t) const { return state(t).head(2).real().cast<double>(); }
  Vector             v(double t) const { return state(t).tail(2).real().cast<double>(); }
  const SmallSystem &system() const { return system_; }

private:
  static Matrix matrix(double a, double b, double c) { return (Matrix(2, 2) << a, b, b, c).finished(); }

  const double                     Omega[2] = {20., 33.}, F[2] = {100., 40.};
  const Eigen::Vector2d            q0{0.01, -0.02}, v0{0., 0.5};
  SmallSystem                      system_;
  Complex4                         s_, c_;
  Eigen::Matrix<LongComplex, 4, 4> X_;
  Complex2                         forced_[2];
};

struct Errors
{
  double q, v;
};

/// Relative errors at t = 1 after n steps; BDF takes exact values at the first points, as the table does.
Errors errors(const LinearPair &pair, const std::string &method, int n)
{
  const double                    h = 1. / n;
  std::unique_ptr<TimeIntegrator> integrator;
  int                             first = 0;
  if (const int order = bdf_order(method))
  {
    auto bdf = std::make_unique<Bdf>(pair.system(), Bdf::Options{order, h});
    first    = order - 1;
    std::vector<Vector> q, v;
    for (int i = first; i >= 0; --i)
    {
      q.push_back(pair.q(i * h));
      v.push_back(pair.v(i * h));
    }
    bdf->begin(first * h, q, v);
    integrator = std::move(bdf);
  }
  else
  {
    integrator = one_step_method(method, pair.system(), h);
    integrator->begin(0., pair.q(0.), pair.v(0.));
  }
  for (int i = first; i < n; ++i)
    integrator->advance();
  const Vector q = pair.q(1.), v = pair.v(1.);
  return {(integrator->instant().q - q).norm() / q.norm(), (integrator->instant().v - v).norm() / v.norm()};
}

TEST(LinearPair, ExactSolutionIsThatOfTheReference)
{
  const LinearPair pair;
  for (const auto &row : read_reference("order/a_linear_2dof.csv"))
  {
    const double t = row.number("t");
    EXPECT_NEAR(pair.q(t)[0], row.number("q1"), 1e-13) << t; // amplitudes 0.3 m and 11 m/s, 15 digits
    EXPECT_NEAR(pair.q(t)[1], row.number("q2"), 1e-13) << t;
    EXPECT_NEAR(pair.v(t)[0], row.number("v1"), 5e-12) << t;
    EXPECT_NEAR(pair.v(t)[1], row.number("v2"), 5e-12) << t;
  }
}

/// Six digits of the table's errors; what rounding does to the solution comes on top.  Its size is h^2-dependent: each
/// step rounds q to eps, and dividing by h and summing over 1/h steps gives eps/h in v, eps in q times the growth of
/// the method's constants.
TEST(OrderTable, ErrorsAreThoseOfTheReferenceToSixDigits)
{
  const LinearPair           pair;
  std::map<std::string, int> rows;
  for (const auto &row : read_reference("order/a_linear_2dof_convergence.csv"))
  {
    const std::string method = row["method"];
    const int         n      = std::stoi(row["steps_to_t_1"]);
    const Errors      found  = errors(pair, method, n);
    const double      q = row.number("rel_error_q(t=1)"), rounding = 1e-15 * n;
    ++rows[method];
    if (q > 1e-9)
    {
      EXPECT_NEAR(found.q, q, 1e-6 * q + rounding) << method << " " << n;
    }
    if (!row.has("rel_error_v(t=1)"))
      continue;
    const double v = row.number("rel_error_v(t=1)");
    if (v > 1e-9)
    {
      EXPECT_NEAR(found.v, v, 1e-6 * v + 10. * rounding) << method << " " << n;
    }
  }
  EXPECT_EQ(rows.size(), 15u);
  for (const auto &[method, count] : rows)
    EXPECT_EQ(count, 6) << method;
}

} // namespace
} // namespace gestell::tests
