#include "coupling/integration/stability/oscillator_step.h"

#include "coupling/integration/bdf/bdf_formula.h"
#include "coupling/integration/newmark/newmark.h"

#include <Eigen/LU>

#include <cmath>

namespace gestell::coupling
{

namespace
{
NewmarkFamily family_of(const Newmark::Options &o)
{
  return {o.alpha_m, o.alpha_f, o.beta, o.gamma};
}
} // namespace

NewmarkFamily newmark_family(const MethodOptions &o)
{
  switch (o.method)
  {
  case Method::hht:
    return family_of(Newmark::hht(o.alpha));
  case Method::generalised_alpha:
    return family_of(Newmark::generalised_alpha(o.rho_inf));
  case Method::central_difference:
    return family_of(Newmark::central_difference());
  case Method::exact:
    return {0., 0., o.force == ForceRule::average ? 0.25 : 1. / 6., 0.5};
  default:
    return {0., 0., o.beta, o.gamma};
  }
}

namespace
{

using LongVector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;
using LongMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

/// Gauss points in (0, 1).
LongVector gauss_points(int s)
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

Eigen::Matrix3d newmark_matrix(const NewmarkFamily &f, const TestOscillator &o)
{
  const double Omega = o.omega_h, c = 2. * o.zeta * Omega, k = Omega * Omega, e = 1. - f.alpha_f;
  const double leading = 1. - f.alpha_m + e * (c * f.gamma + k * f.beta);
  // Row of a_1: what x_0, v_0, a_0 contribute to the balance.
  Eigen::RowVector3d a(-k, -c - e * k, -f.alpha_m - e * (c * (1. - f.gamma) + k * (0.5 - f.beta)));
  a /= leading;
  Eigen::Matrix3d A;
  A.row(0) = Eigen::RowVector3d(1., 1., 0.5 - f.beta) + f.beta * a;
  A.row(1) = Eigen::RowVector3d(0., 1., 1. - f.gamma) + f.gamma * a;
  A.row(2) = a;
  return A;
}

/// Linear acceleration from t to t + theta h, where the balance holds.
Eigen::Matrix3d wilson_matrix(double theta, const TestOscillator &o)
{
  const double Omega = o.omega_h, c = 2. * o.zeta * Omega, k = Omega * Omega, t2 = theta * theta;
  // d = a_1 - a_0:  (theta + c theta^2/2 + k theta^3/6) d = -k x_0 - (c + k theta) v_0 - (1 + c theta + k theta^2/2)
  // a_0
  Eigen::RowVector3d d(-k, -c - k * theta, -1. - c * theta - 0.5 * k * t2);
  d /= theta + 0.5 * c * t2 + k * t2 * theta / 6.;
  Eigen::Matrix3d A;
  A.row(0) = Eigen::RowVector3d(1., 1., 0.5) + d / 6.;
  A.row(1) = Eigen::RowVector3d(0., 1., 1.) + 0.5 * d;
  A.row(2) = Eigen::RowVector3d(0., 0., 1.) + d;
  return A;
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

} // namespace

LongMatrix2 contact_step(const MethodOptions &options, const TestOscillator &o)
{
  const int         s     = options.order / 2;
  const long double Omega = o.omega_h, k = Omega * Omega, c = 2.L * o.zeta * Omega;
  const LongVector  nodes = gauss_points(s), end = LongVector::Ones(1);
  const LongMatrix  velocity = integrals(nodes, nodes, 1), place = integrals(nodes, nodes, 2);
  LongMatrix        start(s, 2); // force at the nodes due to x_0 and h v_0 alone
  start.col(0).setConstant(-k);
  start.col(1)       = (-k * nodes.array() - c).matrix();
  const LongMatrix p = (LongMatrix::Identity(s, s) + k * place + c * velocity).partialPivLu().solve(start);
  LongMatrix2      A;
  A << 1.L, 1.L, 0.L, 1.L;
  A.row(0) += integrals(nodes, end, 2) * p;
  A.row(1) += integrals(nodes, end, 1) * p;
  return A;
}

Eigen::MatrixXd amplification_matrix(const MethodOptions &options, const TestOscillator &o)
{
  switch (options.method)
  {
  case Method::bdf:
    return bdf_matrix(options.order, o);
  case Method::wilson:
    return wilson_matrix(options.theta, o);
  case Method::exact:
    if (o.spring == Spring::base)
      return exact_flow(o);
    if (options.force == ForceRule::collocation)
      return contact_step(options, o).cast<double>();
    break;
  default:
    return newmark_matrix(newmark_family(options), o);
  }
  // The acceleration is what the force at the state makes it: h^2 a = -Omega^2 x - 2 zeta Omega h v.
  const Eigen::Matrix3d       A = newmark_matrix(newmark_family(options), o);
  Eigen::Matrix<double, 3, 2> lift;
  lift << 1., 0., 0., 1., -o.omega_h * o.omega_h, -2. * o.zeta * o.omega_h;
  return (A * lift).topRows<2>();
}

namespace
{

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

} // namespace

Overshoot overshoot(const MethodOptions &options, const TestOscillator &o, OscillatorStart start, BdfStart first_steps)
{
  const double Omega = o.omega_h;
  const double x = start == OscillatorStart::displaced ? 1. : 0., v = start == OscillatorStart::moving ? Omega : 0.;
  Overshoot    largest{std::abs(x), std::abs(v) / Omega, 0, 0};
  const auto   see = [&](double now, double rate, int step)
  {
    if (std::abs(now) > largest.displacement)
      largest.displacement = std::abs(now), largest.displacement_step = step;
    if (std::abs(rate) / Omega > largest.velocity)
      largest.velocity = std::abs(rate) / Omega, largest.velocity_step = step;
  };

  constexpr int n_steps = 20;
  if (options.method != Method::bdf)
  {
    const Eigen::MatrixXd A     = amplification_matrix(options, o);
    Eigen::VectorXd       state = Eigen::VectorXd::Zero(A.rows());
    state[0]                    = x;
    state[1]                    = v;
    if (state.size() == 3)
      state[2] = -Omega * Omega * x - 2. * o.zeta * Omega * v;
    for (int step = 1; step <= n_steps; ++step)
    {
      state = A * state;
      see(state[0], state[1], step);
    }
    return largest;
  }
  const int       p     = options.order;
  Eigen::VectorXd state = Eigen::VectorXd::Zero(2 * p);
  state[0]              = x;
  state[p]              = v;
  for (int step = 1; step <= n_steps; ++step)
  {
    const bool            starts = step < p && first_steps == BdfStart::extrapolated;
    const int             order  = starts ? 1 : std::min(step, p);
    const Eigen::MatrixXd A      = starts ? Eigen::MatrixXd(extrapolated_start(p, o)) : bdf_matrix(order, o);
    Eigen::VectorXd       past(2 * order);
    past << state.head(order), state.segment(p, order);
    const double now = A.row(0).dot(past), rate = A.row(order).dot(past);
    for (int part = 0; part < 2; ++part)
    {
      for (int i = p - 1; i > 0; --i)
        state[part * p + i] = state[part * p + i - 1];
      state[part * p] = part == 0 ? now : rate;
    }
    see(now, rate, step);
  }
  return largest;
}

} // namespace gestell::coupling
