#include "coupling/integration/newmark/wilson_method.h"

#include "coupling/integration/newmark/wilson.h"

#include <sstream>

namespace gestell::coupling
{

namespace
{

/// Linear acceleration from t to t + theta h, where the balance is satisfied.
Eigen::Matrix3d wilson_matrix(double theta, const TestOscillator &o)
{
  const double Omega = o.omega_h, c = 2. * o.zeta * Omega, k = Omega * Omega, t2 = theta * theta;
  // d = a_1 - a_0: (theta + c theta^2/2 + k theta^3/6) d = -k x_0 - (c + k theta) v_0 - (1 + c theta + k theta^2/2) a_0
  Eigen::RowVector3d d(-k, -c - k * theta, -1. - c * theta - 0.5 * k * t2);
  d /= theta + 0.5 * c * t2 + k * t2 * theta / 6.;
  Eigen::Matrix3d A;
  A.row(0) = Eigen::RowVector3d(1., 1., 0.5) + d / 6.;
  A.row(1) = Eigen::RowVector3d(0., 1., 1.) + 0.5 * d;
  A.row(2) = Eigen::RowVector3d(0., 0., 1.) + d;
  return A;
}

/// Wilson's theta: balance at t + theta h, acceleration linear from t to there.  With V (r-1) = h (r+1)/2 A and
/// X (r-1)^2 = h^2 [(r+1)/2 + (1/3 + r/6)(r-1)] A it is, times (r-1)^2 and divided by A,
///
///     (1-theta+theta r)(r-1)^2 + 2 zeta Omega [h V_theta] + Omega^2 [X_theta] = 0,
///
/// and with r = (1+z)/(1-z), times (1-z)^3, a polynomial of third degree.
CharacteristicRoots wilson_roots(double theta_value, const TestOscillator &o)
{
  using Polynomial = std::vector<LongComplex>;
  const auto times = [](const Polynomial &x, const Polynomial &y)
  {
    Polynomial product(x.size() + y.size() - 1);
    for (std::size_t i = 0; i < x.size(); ++i)
      for (std::size_t j = 0; j < y.size(); ++j)
        product[i + j] += x[i] * y[j];
    return product;
  };
  Polynomial sum(4);
  const auto add = [&](long double factor, const Polynomial &x)
  {
    for (std::size_t i = 0; i < x.size(); ++i)
      sum[i] += factor * x[i];
  };
  const long double theta = theta_value, Omega = o.omega_h, square = Omega * Omega;
  const Polynomial  one_minus{1.L, -1.L}, z2{0.L, 0.L, 1.L}, z3{0.L, 0.L, 0.L, 1.L}, z{0.L, 1.L};
  add(4.L, times(z2, {1.L, 2.L * theta - 1.L}));
  // h V_theta (r-1)^2 / A = (r+1)(r-1)/2 + (theta + theta^2/2 (r-1)) (r-1)^2
  add(4.L * o.zeta * Omega, times(z, one_minus));
  add(8.L * o.zeta * Omega * theta, times(z2, one_minus));
  add(8.L * o.zeta * Omega * theta * theta, z3);
  // X_theta (r-1)^2 / A = (r+1)/2 + (1/3 + r/6)(r-1) + theta (r+1)(r-1)/2 + theta^2/2 (r-1)^2 + theta^3/6 (r-1)^3
  add(square, times(one_minus, one_minus));
  add(square, times(times(z, one_minus), {1.L, -1.L / 3.L}));
  add(2.L * square * theta, times(z, one_minus));
  add(2.L * square * theta * theta, times(z2, one_minus));
  add(4.L / 3.L * square * theta * theta * theta, z3);
  return roots_of_z(sum);
}

class WilsonMethod final : public IntegrationMethod
{
public:
  std::string name() const override { return "wilson"; }
  std::string meaning() const override
  {
    return "Wilson's theta method: acceleration linear over theta h, equilibrium at its end.";
  }
  const std::vector<MethodParameter> &parameters() const override
  {
    static const std::vector<MethodParameter> all = {{"theta",
                                                      "time of equilibrium, in steps; stable at 1.366 and above", 1.4,
                                                      "1 or more", [](double theta) { return theta >= 1.; }}};
    return all;
  }
  std::string label(const MethodOptions &o) const override
  {
    std::ostringstream text;
    text << "Wilson theta " << number(o, "theta");
    return text.str();
  }
  std::unique_ptr<TimeIntegrator> make(const SecondOrderSystem &system, const MethodOptions &o) const override
  {
    Wilson::Options options;
    options.theta        = number(o, "theta");
    options.step         = o.step;
    options.max_halvings = o.max_halvings;
    options.newton       = o.newton;
    return std::make_unique<Wilson>(system, options);
  }
  Eigen::MatrixXd amplification_matrix(const MethodOptions &options, const TestOscillator &o) const override
  {
    return wilson_matrix(number(options, "theta"), o);
  }
  CharacteristicRoots roots(const MethodOptions &options, const TestOscillator &o) const override
  {
    return wilson_roots(number(options, "theta"), o);
  }
  std::optional<StepWeights> step_weights(const MethodOptions &options, double r) const override
  {
    const double d = r - 1., theta = number(options, "theta"), half = 0.5 * theta * theta; // see wilson_roots()
    return StepWeights{-(1. - theta + theta * r) * d * d, -(0.5 * (r + 1.) * d + (theta + half * d) * d * d),
                       -(0.5 * (r + 1.) + (1. / 3. + r / 6.) * d + 0.5 * theta * (r + 1.) * d + half * d * d +
                         theta * theta * theta / 6. * d * d * d)};
  }
  std::string family() const override { return "Newmark"; }
};

} // namespace

const IntegrationMethod &wilson_method()
{
  static const WilsonMethod method;
  return method;
}

} // namespace gestell::coupling
