#include "coupling/integration/stability/stability.h"

#include "coupling/integration/integration_methods.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>
#include <stdexcept>

namespace gestell::coupling
{

namespace
{

/// Golden section for the largest f in [a, b], to 1e-9 of its width: 1e-18 of the height of a peak.
double highest(const std::function<long double(double)> &f, double a, double b)
{
  const double golden = 0.6180339887498949;
  double       x = b - golden * (b - a), y = a + golden * (b - a);
  long double  fx = f(x), fy = f(y);
  for (int i = 0; i < 45; ++i)
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

constexpr long double pi = 3.141592653589793238462643383279502884L;

CharacteristicRoots roots_of(const MethodOptions &options, const TestOscillator &o)
{
  return method_of(options).roots(options, o);
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

const CharacteristicRoot &principal(const std::vector<CharacteristicRoot> &roots, const TestOscillator &o)
{
  const LongComplex mu   = exponent(o);
  const bool        seen = mu.imag() < pi;
  const auto        rank = [&](const CharacteristicRoot &root) -> long double
  {
    if (seen)
      return -std::abs(root.r - std::exp(mu));
    return root.r.imag() != 0.L ? root.log_abs : -1e9L + root.log_abs;
  };
  return *std::max_element(roots.begin(), roots.end(),
                           [&](const CharacteristicRoot &a, const CharacteristicRoot &b) { return rank(a) < rank(b); });
}

} // namespace

StepProperties step_properties(const MethodOptions &options, const TestOscillator &o)
{
  require_oscillator(o);
  const CharacteristicRoots roots   = roots_of(options, o);
  long double               largest = -std::numeric_limits<long double>::infinity();
  for (const CharacteristicRoot &root : roots.all)
    largest = std::max(largest, root.log_abs);
  const double   nan = std::numeric_limits<double>::quiet_NaN();
  StepProperties properties{static_cast<double>(std::exp(largest)), static_cast<double>(largest), nan, nan};

  const CharacteristicRoot &root  = principal(roots.all, o);
  const long double         angle = std::abs(std::arg(root.r));
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

namespace
{

using Margin = std::function<long double(double)>; // of ln(omega h)

/// Position between a and b at which f changes its sign.
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

struct Sample
{
  double      x; // ln(omega h)
  long double margin;
};

/// A grid of ln(omega h), joined by the peaks between its points that could be islands of growth or lakes of stability,
/// so that none is stepped over.
std::vector<Sample> samples(const Margin &f)
{
  constexpr int       n           = 600;                       // 46 a decade of omega h
  constexpr double    least_omega = 1e-6, largest_omega = 1e7; // range of omega h in which intervals are searched
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

} // namespace gestell::coupling
