#include "coupling/integration/bdf/bdf_method.h"

#include "coupling/integration/bdf/bdf.h"
#include "coupling/integration/bdf/bdf_controlled.h"
#include "coupling/integration/bdf/bdf_formula.h"

#include <algorithm>
#include <cmath>

namespace gestell::coupling
{

namespace
{

/// with a tolerance, where no order is given: order 6 is stable in too narrow a sector
constexpr int highest_order = 5;

/// BDF of order p in w = 1 - 1/r:  sum_{j=1..p} w^j / j = mu, and ln r = -ln(1 - w) = mu + sum_{j>p} w^j / j, which
/// gives the growth of the principal root without cancellation.
void add_bdf_roots(int order, LongComplex mu, std::vector<CharacteristicRoot> &roots)
{
  std::vector<LongComplex> polynomial(order + 1);
  polynomial[0] = -mu;
  for (int j = 1; j <= order; ++j)
    polynomial[j] = 1.L / j;
  for (const LongComplex &w : polynomial_roots(polynomial))
  {
    long double log_abs = -0.5L * std::log1p(-2.L * w.real() + std::norm(w));
    if (std::abs(w) < 0.2L && std::abs(w - mu) < 0.5L * std::abs(mu))
    {
      log_abs           = mu.real();
      LongComplex power = std::pow(w, order);
      for (int j = order + 1; j < order + 40; ++j) // 0.2^40 is below rounding
        log_abs += (power *= w).real() / j;
    }
    roots.push_back({1.L / (1.L - w), log_abs});
  }
}

CharacteristicRoots bdf_roots(int order, const TestOscillator &o)
{
  CharacteristicRoots roots{{}, -1.L};
  add_bdf_roots(order, exponent(o), roots.all);
  if (o.zeta > 1.) // two real solutions instead of a conjugate pair, whose roots would only be conjugate
    add_bdf_roots(order, -2.L * o.zeta * o.omega_h - exponent(o), roots.all);
  for (const CharacteristicRoot &root : roots.all)
    roots.margin = std::max(roots.margin, root.log_abs);
  return roots;
}

/// h beta0 y'_k = y_k + sum alpha_i y_{k-i} for y = x and y = x'.
Eigen::MatrixXd bdf_matrix(int p, const TestOscillator &o)
{
  const BdfFormula &formula = bdf_formulas[p - 1];
  const double      b = formula.beta0, c = 2. * o.zeta * o.omega_h, k = o.omega_h * o.omega_h;
  // x = hx + b v,  v = hv - b (k x + c v)
  const double    D = 1. + b * c + b * b * k;
  Eigen::Matrix2d of_past;
  of_past << (1. + b * c) / D, b / D, -b * k / D, 1. / D;
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2 * p, 2 * p);
  for (int i = 0; i < p; ++i)
    for (int part = 0; part < 2; ++part)
    {
      A(0, part * p + i) = -formula.alpha[i] * of_past(0, part);
      A(p, part * p + i) = -formula.alpha[i] * of_past(1, part);
      if (i > 0)
        A(part * p + i, part * p + i - 1) = 1.;
    }
  return A;
}

/// A step of the start of BDF p on (x, h x'): implicit Euler in 1, 2, ... parts, extrapolated to order p (3 for p = 2).
Eigen::Matrix2d extrapolated_start(int p, const TestOscillator &o)
{
  const int                    order = p == 2 ? 3 : p;
  std::vector<Eigen::Matrix2d> table(static_cast<std::size_t>(order));
  for (int j = 0; j < order; ++j)
  {
    const double          parts = j + 1.;
    const Eigen::Matrix2d part  = bdf_matrix(1, {o.zeta, o.omega_h / parts, o.spring});
    Eigen::Matrix2d       chain = Eigen::Matrix2d::Identity();
    for (int i = 0; i <= j; ++i)
      chain = part * chain;
    chain(0, 1) /= parts; // of (x, h x'/parts) to (x, h x')
    chain(1, 0) *= parts;
    table[j] = chain;
    for (int k = j - 1; k >= 0; --k)
      table[k] = table[k + 1] + (table[k + 1] - table[k]) / ((j + 1.) / (k + 1.) - 1.);
  }
  return table[0];
}

class BdfMethod final : public IntegrationMethod
{
public:
  std::string name() const override { return "bdf"; }
  std::string meaning() const override
  {
    return "Backward differences, (5.5.2/6); order 2 is stable for every mode at any step.";
  }
  bool        takes_order() const override { return true; }
  int         default_order(const MethodOptions &o) const override { return controlled(o) ? highest_order : 2; }
  bool        can_control_error() const override { return true; }
  std::string label(const MethodOptions &o) const override { return "BDF " + std::to_string(o.order); }
  void        check(const MethodOptions &o) const override
  {
    require_parameter(o.order >= 1 && o.order <= 6, label(o), "order", o.order, "1 to 6");
  }
  std::unique_ptr<TimeIntegrator> make(const SecondOrderSystem &system, const MethodOptions &o) const override;
  Eigen::MatrixXd amplification_matrix(const MethodOptions &options, const TestOscillator &o) const override
  {
    return bdf_matrix(options.order, o);
  }
  CharacteristicRoots roots(const MethodOptions &options, const TestOscillator &o) const override
  {
    return bdf_roots(options.order, o);
  }
  std::vector<Eigen::Vector2d> first_steps(const MethodOptions &options, const TestOscillator &o,
                                           const Eigen::Vector2d &start, int n, FirstSteps kind) const override;
  std::string                  energy_advice(const MethodOptions &o) const override
  {
    return controlled(o) || o.order >= 4 ? ""
                                         : "For many revolutions or oscillations, order = 4 with at least 60 steps per "
                                           "period loses far less energy";
  }
  std::string               family() const override { return "BDF"; }
  std::vector<ChartSetting> chart_settings() const override;
};

std::unique_ptr<TimeIntegrator> BdfMethod::make(const SecondOrderSystem &system, const MethodOptions &o) const
{
  if (controlled(o))
  {
    BdfControlled::Options options;
    options.tolerance    = o.tolerance;
    options.largest_step = o.step;
    options.max_order    = o.order;
    options.newton       = o.newton;
    return std::make_unique<BdfControlled>(system, options);
  }
  Bdf::Options options;
  options.order        = o.order;
  options.step         = o.step;
  options.max_halvings = o.max_halvings;
  options.newton       = o.newton;
  return std::make_unique<Bdf>(system, options);
}

std::vector<Eigen::Vector2d> BdfMethod::first_steps(const MethodOptions &options, const TestOscillator &o,
                                                    const Eigen::Vector2d &start, int n, FirstSteps kind) const
{
  const int       p     = options.order;
  Eigen::VectorXd state = Eigen::VectorXd::Zero(2 * p);
  state[0]              = start[0];
  state[p]              = start[1];
  std::vector<Eigen::Vector2d> states;
  for (int step = 1; step <= n; ++step)
  {
    const bool            starts = step < p && kind == FirstSteps::as_integrated;
    const int             order  = starts ? 1 : std::min(step, p);
    const Eigen::MatrixXd A      = starts ? Eigen::MatrixXd(extrapolated_start(p, o)) : bdf_matrix(order, o);
    Eigen::VectorXd       past(2 * order);
    past << state.head(order), state.segment(p, order);
    const Eigen::Vector2d now(A.row(0).dot(past), A.row(order).dot(past));
    for (int part = 0; part < 2; ++part)
    {
      for (int i = p - 1; i > 0; --i)
        state[part * p + i] = state[part * p + i - 1];
      state[part * p] = now[part];
    }
    states.push_back(now);
  }
  return states;
}

std::vector<ChartSetting> BdfMethod::chart_settings() const
{
  std::vector<ChartSetting> settings;
  const auto                add = [&](int order, bool controlled)
  {
    MethodOptions options = named();
    options.order         = order;
    settings.push_back({"bdf-" + std::to_string(order) + (controlled ? "-controlled" : ""), options, controlled,
                        !controlled && order != 2});
  };
  for (const int order : {1, 2, 3, 4, 5, 6})
    add(order, false);
  for (const int order : {2, 5})
    add(order, true);
  return settings;
}

} // namespace

const IntegrationMethod &bdf_method()
{
  static const BdfMethod method;
  return method;
}

} // namespace gestell::coupling
