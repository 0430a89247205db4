#include "coupling/integration/propagation/propagation_method.h"

#include "coupling/integration/newmark/newmark_family.h"
#include "coupling/integration/propagation/modal_propagation.h"
#include "coupling/integration/step/rounding_floors.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace gestell::coupling
{

namespace
{

constexpr int collocation_order = 4; ///< where none is given

using LongVector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;
using LongMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

/// Gauss points in (0, 1), to the last bit of the tables made of them.
LongVector collocation_points(int s)
{
  LongVector c(s);
  switch (s)
  {
  case 1:
    c << 0.L;
    break;
  case 2:
    c << -std::sqrt(1.L / 3.L), std::sqrt(1.L / 3.L);
    break;
  case 3:
    c << -std::sqrt(0.6L), 0.L, std::sqrt(0.6L);
    break;
  default:
  {
    const long double root  = 2.L / 7.L * std::sqrt(1.2L);
    const long double inner = std::sqrt(3.L / 7.L - root), outer = std::sqrt(3.L / 7.L + root);
    c << -outer, -inner, inner, outer;
  }
  }
  return (0.5L + 0.5L * c.array()).matrix();
}

/// Weights with which p_1 ... p_s, through Gauss points c, give  int_0^x (x-t)^(k-1) p(t) dt,  k = 1 or 2, at each x.
LongMatrix integrals(const LongVector &c, const LongVector &x, int k)
{
  const auto s = c.size();
  LongMatrix powers(s, s), moments(x.size(), s); // of monomials: at c, and integrated up to x
  for (Eigen::Index j = 0; j < s; ++j)
    for (Eigen::Index i = 0; i < s; ++i)
      powers(i, j) = std::pow(c[i], static_cast<long double>(j));
  for (Eigen::Index j = 0; j < s; ++j)
    for (Eigen::Index i = 0; i < x.size(); ++i)
    {
      const auto n  = static_cast<long double>(j);
      moments(i, j) = std::pow(x[i], n + k) / (k == 1 ? n + 1.L : (n + 1.L) * (n + 2.L));
    }
  return powers.transpose().partialPivLu().solve(moments.transpose()).transpose();
}

/// The flow of the oscillator over one step on (x, h x'), from its two exponents: no overflow however stiff.
Eigen::Matrix2d exact_flow(const TestOscillator &o)
{
  using Complex        = std::complex<double>;
  const Complex   root = o.omega_h * std::sqrt(Complex(o.zeta * o.zeta - 1.));
  const Complex   a = -o.zeta * o.omega_h + root, b = -o.zeta * o.omega_h - root;
  const Complex   ea = std::exp(a), eb = std::exp(b);
  const bool      apart = std::abs(a - b) > 1e-6 * o.omega_h;
  const Complex   slope = apart ? (ea - eb) / (a - b) : std::exp(0.5 * (a + b));
  const Complex   place = apart ? (a * eb - b * ea) / (a - b) : (1. - 0.5 * (a + b)) * slope;
  Eigen::Matrix2d A;
  A << place.real(), slope.real(), -o.omega_h * o.omega_h * slope.real(), (place + (a + b) * slope).real();
  return A;
}

class PropagationMethod final : public IntegrationMethod
{
public:
  std::string name() const override { return "exact"; }
  std::string meaning() const override
  {
    return "Modal propagation: the linear base system exactly, the forces of the elements interpolated over a step.";
  }
  const std::vector<MethodParameter> &parameters() const override
  {
    static const std::vector<MethodParameter> all = {
        {"force", "interpolation of element forces over a step", 0., "", {}, {"collocation", "average", "linear"}}};
    return all;
  }
  bool        takes_order() const override { return true; }
  int         default_order(const MethodOptions &o) const override { return collocates(o) ? collocation_order : 0; }
  bool        can_control_error() const override { return true; }
  std::string label(const MethodOptions &o) const override
  {
    return "exact, " + (collocates(o) ? "collocation " + std::to_string(o.order) : choice(o, "force") + " force");
  }
  void                            check(const MethodOptions &o) const override;
  std::unique_ptr<TimeIntegrator> make(const SecondOrderSystem &system, const MethodOptions &o) const override;
  Eigen::MatrixXd     amplification_matrix(const MethodOptions &options, const TestOscillator &o) const override;
  CharacteristicRoots roots(const MethodOptions &options, const TestOscillator &o) const override;
  bool                carries_base() const override { return true; }
  bool                takes_long_steps(const MethodOptions &o) const override { return controlled(o) || collocates(o); }
  std::string         family() const override { return "exact"; }
  std::vector<ChartSetting> chart_settings() const override;

private:
  bool      collocates(const MethodOptions &o) const { return choice(o, "force") == "collocation"; }
  ForceRule rule(const MethodOptions &o) const
  {
    return collocates(o)                    ? ForceRule::collocation
           : choice(o, "force") == "linear" ? ForceRule::linear
                                            : ForceRule::average;
  }
  /// A mean (beta = 1/4) or a linear force (beta = 1/6) is what Newmark's formulas integrate.
  NewmarkFamily of_contact(const MethodOptions &o) const
  {
    return {0., 0., rule(o) == ForceRule::average ? 0.25 : 1. / 6., 0.5};
  }
};

void PropagationMethod::check(const MethodOptions &o) const
{
  require_parameter(!collocates(o) || (o.order % 2 == 0 && o.order >= 2 && o.order <= 8), label(o), "order", o.order,
                    "2, 4, 6 or 8");
  require_parameter(!controlled(o) || collocates(o), label(o), "tolerance", o.tolerance,
                    "omitted, because only force = \"collocation\" controls its step");
}

std::unique_ptr<TimeIntegrator> PropagationMethod::make(const SecondOrderSystem &system, const MethodOptions &o) const
{
  ModalPropagation::Options options;
  options.force     = rule(o);
  options.order     = o.order;
  options.step      = o.step;
  options.tolerance = o.tolerance;
  options.newton    = o.newton;
  options.modes     = o.modes;
  // Newton's tolerance in units of the error tolerance: small compared with it
  constexpr double share_of_newton = 1e-2;
  if (controlled(o))
    options.newton.tolerance = std::max(share_of_newton * o.tolerance, finest_tolerance);
  else
    options.max_halvings = o.max_halvings;
  return std::make_unique<ModalPropagation>(system, options);
}

Eigen::MatrixXd PropagationMethod::amplification_matrix(const MethodOptions &options, const TestOscillator &o) const
{
  if (o.spring == Spring::base)
    return exact_flow(o);
  if (collocates(options))
    return contact_step(options.order, o).cast<double>();
  // The acceleration follows from the force at the state: h^2 a = -Omega^2 x - 2 zeta Omega h v.
  Eigen::Matrix<double, 3, 2> lift;
  lift << 1., 0., 0., 1., -o.omega_h * o.omega_h, -2. * o.zeta * o.omega_h;
  return (newmark_matrix(of_contact(options), o) * lift).topRows<2>();
}

CharacteristicRoots PropagationMethod::roots(const MethodOptions &options, const TestOscillator &o) const
{
  if (o.spring == Spring::base)
  {
    const LongComplex mu = exponent(o);
    return {{{std::exp(mu), mu.real()}}, mu.real()};
  }
  return collocates(options) ? roots_of_map(contact_step(options.order, o)) : newmark_roots(of_contact(options), o);
}

std::vector<ChartSetting> PropagationMethod::chart_settings() const
{
  std::vector<ChartSetting> settings;
  for (const char *rule : {"average", "linear"})
  {
    MethodOptions options = named();
    options.set("force", rule);
    settings.push_back({std::string("exact-") + rule, options, false});
  }
  for (const bool controlled : {false, true})
    for (const int order : {2, 4, 6, 8})
    {
      MethodOptions options = named();
      options.order         = order;
      settings.push_back({"exact-" + std::to_string(order) + (controlled ? "-controlled" : ""), options, controlled});
    }
  return settings;
}

} // namespace

const IntegrationMethod &propagation_method()
{
  static const PropagationMethod method;
  return method;
}

LongMatrix2 contact_step(int order, const TestOscillator &o)
{
  const int         s     = order / 2;
  const long double Omega = o.omega_h, k = Omega * Omega, c = 2.L * o.zeta * Omega;
  const LongVector  nodes = collocation_points(s), end = LongVector::Ones(1);
  const LongMatrix  velocity = integrals(nodes, nodes, 1), place = integrals(nodes, nodes, 2);
  LongMatrix        start(s, 2); // force at the nodes due to x_0 and h v_0 only
  start.col(0).setConstant(-k);
  start.col(1)       = (-k * nodes.array() - c).matrix();
  const LongMatrix p = (LongMatrix::Identity(s, s) + k * place + c * velocity).partialPivLu().solve(start);
  LongMatrix2      A;
  A << 1.L, 1.L, 0.L, 1.L;
  A.row(0) += integrals(nodes, end, 2) * p;
  A.row(1) += integrals(nodes, end, 1) * p;
  return A;
}

} // namespace gestell::coupling
