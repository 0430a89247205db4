#include "coupling/integration/stability/stability.h"

#include "coupling/integration/bdf/bdf_formula.h"
#include "coupling/integration/stability/oscillator_step.h"
#include "coupling/integration/stability/polynomial_roots.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>
#include <stdexcept>

namespace gestell::coupling
{

namespace
{

constexpr long double pi          = 3.141592653589793238462643383279502884L;
constexpr double      least_omega = 1e-6, largest_omega = 1e7; // omega h between which intervals are looked for

/// A root r of the characteristic polynomial; log_abs = ln|r| keeps its digits where |r| is close to 1.
struct Root
{
  LongComplex r;
  long double log_abs;
};

/// Roots, and a margin that is negative where none of them grows and positive where one does, without the noise of
/// rounding that |r| - 1 has along an axis of neutral stability.
struct Roots
{
  std::vector<Root> all;
  long double       margin;
};

LongComplex exponent(const TestOscillator &o)
{
  const long double zeta = o.zeta;
  return static_cast<long double>(o.omega_h) * (-zeta + std::sqrt(LongComplex(zeta * zeta - 1.L)));
}

/// BDF of order p in w = 1 - 1/r:  sum_{j=1..p} w^j / j = mu, and ln r = -ln(1 - w) = mu + sum_{j>p} w^j / j, which
/// tells the growth of the principal root without cancellation.
void add_bdf_roots(int order, LongComplex mu, std::vector<Root> &roots)
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

Roots bdf_roots(int order, const TestOscillator &o)
{
  Roots roots{{}, -1.L};
  add_bdf_roots(order, exponent(o), roots.all);
  if (o.zeta > 1.) // two real solutions instead of a conjugate pair, whose roots would only be conjugate
    add_bdf_roots(order, -2.L * o.zeta * o.omega_h - exponent(o), roots.all);
  for (const Root &root : roots.all)
    roots.margin = std::max(roots.margin, root.log_abs);
  return roots;
}

/// Roots from z = (r - 1)/(r + 1): |r| > 1 where Re z > 0.  Rounding moves z by 1e-18 of itself; what it moves |r| by
/// must not count as growth.
Roots roots_of_z(const std::vector<LongComplex> &polynomial)
{
  Roots roots{{}, -1.L};
  for (const LongComplex &z : polynomial_roots(polynomial))
  {
    const long double size = std::abs(z);
    roots.all.push_back({(1.L + z) / (1.L - z), 0.5L * std::log1p(4.L * z.real() / std::norm(1.L - z))});
    roots.margin = std::max(roots.margin, z.real() / size - 1e-15L * (1.L + size));
  }
  while (roots.all.size() + 1 < polynomial.size()) // a leading coefficient is zero: z = infinity
    roots.all.push_back({-1.L, 0.L});
  return roots;
}

/// Newmark's family, with E = (1 - alpha_f) r + alpha_f and so on,
///
///     ((1-alpha_m) r + alpha_m) (r-1)^2 + 2 zeta Omega E (1-gamma+gamma r)(r-1)
///       + Omega^2 E [1-gamma+gamma r + (1/2-beta+beta r)(r-1)] = 0,
///
/// becomes with r = (1+z)/(1-z), and times (1-z)^3,
///
///     4 z^2 (1+a z) + 4 zeta Omega z (1+b z)(1+c z) + Omega^2 (1+b z)(1 + c z + d z^2) = 0,
///     a = 1 - 2 alpha_m,  b = 1 - 2 alpha_f,  c = 2 gamma - 1,  d = 4 beta - 2 gamma.
Roots newmark_roots(const NewmarkFamily &f, const TestOscillator &o)
{
  const long double a = 1.L - 2.L * f.alpha_m, b = 1.L - 2.L * f.alpha_f, c = 2.L * f.gamma - 1.L,
                    d       = 4.L * f.beta - 2.L * f.gamma;
  const long double Omega   = o.omega_h;
  const long double damping = 4.L * o.zeta * Omega, square = Omega * Omega;
  if (f.alpha_m == 0. && f.alpha_f == 0.) // the factor 1 + z, r = 0, is left out
    return roots_of_z({square, damping + square * c, 4.L + damping * c + square * d});
  return roots_of_z({square, damping + square * (b + c), 4.L + damping * (b + c) + square * (b * c + d),
                     4.L * a + damping * b * c + square * b * d});
}

/// Wilson's theta: balance at t + theta h, acceleration linear from t to there.  With V (r-1) = h (r+1)/2 A and
/// X (r-1)^2 = h^2 [(r+1)/2 + (1/3 + r/6)(r-1)] A it is, times (r-1)^2 and divided by A,
///
///     (1-theta+theta r)(r-1)^2 + 2 zeta Omega [h V_theta] + Omega^2 [X_theta] = 0,
///
/// and with r = (1+z)/(1-z), times (1-z)^3, a polynomial of third degree.
Roots wilson_roots(double theta_value, const TestOscillator &o)
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

/// From trace and determinant of a 2 x 2 map; stable while |trace| <= 1 + det and det <= 1.  The second holds: det is 1
/// without damping, which as a margin would hide how close the first comes to its limit between two islands of growth.
Roots contact_roots(const LongMatrix2 &A)
{
  const long double trace = A(0, 0) + A(1, 1), det = A(0, 0) * A(1, 1) - A(0, 1) * A(1, 0);
  const long double discriminant = 0.25L * trace * trace - det;
  Roots             roots{{}, (det > 1.L + 1e-15L ? det : std::abs(trace) - det) - 1.L - 1e-16L};
  if (discriminant < 0.L)
  {
    const LongComplex r(0.5L * trace, std::sqrt(-discriminant));
    const long double log_abs = 0.5L * std::log(det);
    roots.all                 = {{r, log_abs}, {std::conj(r), log_abs}};
    return roots;
  }
  const long double large = 0.5L * trace + std::copysign(std::sqrt(discriminant), trace);
  for (const long double r : {large, large != 0.L ? det / large : 0.L})
    roots.all.push_back({r, std::log(std::abs(r))});
  return roots;
}

Roots roots_of(const MethodOptions &options, const TestOscillator &o)
{
  switch (options.method)
  {
  case Method::bdf:
    return bdf_roots(options.order, o);
  case Method::wilson:
    return wilson_roots(options.theta, o);
  case Method::exact:
    if (o.spring == Spring::base)
    {
      const LongComplex mu = exponent(o);
      return {{{std::exp(mu), mu.real()}}, mu.real()};
    }
    if (options.force == ForceRule::collocation)
      return contact_roots(contact_step(options, o));
    [[fallthrough]]; // a mean or linear force is what Newmark's formulas integrate
  default:
    return newmark_roots(newmark_family(options), o);
  }
}

void require_oscillator(const TestOscillator &o)
{
  if (o.omega_h > 0. && std::isfinite(o.omega_h) && o.zeta >= 0. && std::isfinite(o.zeta))
    return;
  std::ostringstream message;
  message << "stability: omega h is " << o.omega_h << " and the damping ratio " << o.zeta
          << "; the first must be positive, the second not negative";
  throw std::invalid_argument(message.str());
}

const Root &principal(const std::vector<Root> &roots, const TestOscillator &o)
{
  const LongComplex mu   = exponent(o);
  const bool        seen = mu.imag() < pi;
  const auto        rank = [&](const Root &root) -> long double
  {
    if (seen)
      return -std::abs(root.r - std::exp(mu));
    return root.r.imag() != 0.L ? root.log_abs : -1e9L + root.log_abs;
  };
  return *std::max_element(roots.begin(), roots.end(), [&](const Root &a, const Root &b) { return rank(a) < rank(b); });
}

} // namespace

StepProperties step_properties(const MethodOptions &options, const TestOscillator &o)
{
  require_oscillator(o);
  const Roots roots   = roots_of(options, o);
  long double largest = -std::numeric_limits<long double>::infinity();
  for (const Root &root : roots.all)
    largest = std::max(largest, root.log_abs);
  const double   nan = std::numeric_limits<double>::quiet_NaN();
  StepProperties properties{static_cast<double>(std::exp(largest)), static_cast<double>(largest), nan, nan};

  const Root       &root  = principal(roots.all, o);
  const long double angle = std::abs(std::arg(root.r));
  if (o.zeta >= 1. || angle < 1e-12L * o.omega_h || angle > pi - 1e-7L) // a double root at -1 splits by rounding
    return properties;
  const long double zeta       = o.zeta;
  properties.period_elongation = static_cast<double>(o.omega_h * std::sqrt(1.L - zeta * zeta) / angle - 1.L);
  properties.numerical_damping = static_cast<double>(-root.log_abs / std::hypot(root.log_abs, angle) - zeta);
  return properties;
}

double spectral_radius(const MethodOptions &options, const TestOscillator &o)
{
  return step_properties(options, o).spectral_radius;
}

bool has_step_weights(const MethodOptions &options)
{
  return options.method == Method::newmark || options.method == Method::central_difference ||
         options.method == Method::wilson;
}

StepWeights step_weights(const MethodOptions &options, double r)
{
  if (!has_step_weights(options))
    throw std::invalid_argument("step_weights: " + method_name(options) + " has none");
  const double d = r - 1.;
  if (options.method == Method::wilson)
  {
    const double theta = options.theta, half = 0.5 * theta * theta; // see wilson_roots()
    return {-(1. - theta + theta * r) * d * d, -(0.5 * (r + 1.) * d + (theta + half * d) * d * d),
            -(0.5 * (r + 1.) + (1. / 3. + r / 6.) * d + 0.5 * theta * (r + 1.) * d + half * d * d +
              theta * theta * theta / 6. * d * d * d)};
  }
  const NewmarkFamily f    = newmark_family(options);
  const double        mean = 1. - f.gamma + f.gamma * r;
  return {d * d, d * mean, mean + d * (0.5 - f.beta + f.beta * r)};
}

namespace
{

using Margin = std::function<long double(double)>; // of ln(omega h)

/// Where the sign of f changes between a and b.
double boundary(const Margin &f, double a, double b)
{
  const bool grows = f(a) > 0.L;
  for (int i = 0; i < 60 && std::abs(b - a) > 1e-15 * std::abs(a); ++i)
  {
    const double middle                  = 0.5 * (a + b);
    ((f(middle) > 0.L) == grows ? a : b) = middle;
  }
  return 0.5 * (a + b);
}

/// Golden section for the largest f in [a, b].
double highest(const Margin &f, double a, double b)
{
  const double golden = 0.6180339887498949;
  double       x = b - golden * (b - a), y = a + golden * (b - a);
  long double  fx = f(x), fy = f(y);
  for (int i = 0; i < 45; ++i) // 0.618^45 is below 1e-9 of a peak's width: 1e-18 of its height
    if (fx > fy)
    {
      b = y, y = x, fy = fx;
      fx = f(x = b - golden * (b - a));
    }
    else
    {
      a = x, x = y, fx = fy;
      fy = f(y = a + golden * (b - a));
    }
  return 0.5 * (a + b);
}

struct Sample
{
  double      x; // ln(omega h)
  long double margin;
};

/// A grid of ln(omega h), joined by the peaks between its points that could be islands of growth or lakes of stability,
/// so that none is stepped over.
std::vector<Sample> samples(const Margin &f)
{
  constexpr int       n = 600;
  const double        a = std::log(least_omega), b = std::log(largest_omega);
  std::vector<Sample> grid(n + 1), all;
  for (int i = 0; i <= n; ++i)
    grid[i] = {a + (b - a) * i / n, f(a + (b - a) * i / n)};
  for (int i = 0; i <= n; ++i)
  {
    all.push_back(grid[i]);
    const long double y = grid[i].margin;
    if (i == 0 || i == n || std::abs(y) > 0.1L)
      continue;
    if (std::max({std::abs(grid[i - 1].margin), std::abs(y), std::abs(grid[i + 1].margin)}) < 1e-14L)
      continue; // neutral, with the noise of rounding
    const bool grows = y > 0.L;
    const auto sign  = grows ? -1.L : 1.L;
    const auto below = [&](const Sample &other)
    { return (other.margin > 0.L) == grows && sign * (y - other.margin) >= 0.L; };
    if (!below(grid[i - 1]) || !below(grid[i + 1]))
      continue;
    const double peak = highest([&](double x) { return sign * f(x); }, grid[i - 1].x, grid[i + 1].x);
    all.push_back({peak, f(peak)});
  }
  std::sort(all.begin(), all.end(), [](const Sample &left, const Sample &right) { return left.x < right.x; });
  return all;
}

} // namespace

std::vector<UnstableInterval> unstable_intervals(const MethodOptions &options, double zeta, Spring spring)
{
  const Margin margin = [&](double x) { return roots_of(options, {zeta, std::exp(x), spring}).margin; };
  const Margin growth = [&](double x) {
    return static_cast<long double>(step_properties(options, {zeta, std::exp(x), spring}).log_growth);
  };

  std::vector<UnstableInterval> intervals;
  const std::vector<Sample>     grid = samples(margin);
  for (std::size_t i = 0; i < grid.size(); ++i)
  {
    if (!(grid[i].margin > 0.L))
      continue;
    const std::size_t first = i;
    std::size_t       best  = i;
    for (long double most = growth(grid[i].x); i + 1 < grid.size() && grid[i + 1].margin > 0.L; ++i)
      if (const long double next = growth(grid[i + 1].x); next > most)
        most = next, best = i + 1;
    const bool   from_zero = first == 0, endless = i + 1 == grid.size();
    const double from = from_zero ? grid.front().x : boundary(margin, grid[first - 1].x, grid[first].x);
    const double to   = endless ? grid.back().x : boundary(margin, grid[i].x, grid[i + 1].x);
    const double peak = highest(growth, best == first ? from : grid[best - 1].x, best == i ? to : grid[best + 1].x);
    intervals.push_back({from_zero ? 0. : std::exp(from),
                         endless ? std::numeric_limits<double>::infinity() : std::exp(to),
                         static_cast<double>(std::exp(growth(peak))), std::exp(peak)});
  }
  return intervals;
}

double sufficient_damping(int bdf_order)
{
  if (bdf_order <= 2)
    return 0.; // A-stable
  // Along |r| = 1, r = exp(i phi):  mu = sum (1 - 1/r)^j / j; the largest damping ratio met there.
  const Margin ratio = [&](double phi)
  {
    const LongComplex w  = 1.L - std::polar(1.L, -static_cast<long double>(phi));
    LongComplex       mu = 0.L, power = 1.L;
    for (int j = 1; j <= bdf_order; ++j)
      mu += (power *= w) / static_cast<long double>(j);
    return -mu.real() / std::abs(mu);
  };
  double best = 1e-3;
  for (double phi = best; phi < 3.14; phi += 1e-3)
    best = ratio(phi) > ratio(best) ? phi : best;
  return static_cast<double>(ratio(highest(ratio, best - 1e-3, best + 1e-3)));
}

} // namespace gestell::coupling
