#include "coupling/integration/stability/polynomial_roots.h"

#include <cmath>
#include <limits>

namespace gestell::coupling
{

namespace
{

/// One root, from the start x.
LongComplex laguerre(const std::vector<LongComplex> &a, LongComplex x)
{
  constexpr long double eps    = std::numeric_limits<long double>::epsilon();
  const auto            degree = static_cast<long double>(a.size() - 1);
  for (int iteration = 1; iteration <= 80; ++iteration)
  {
    LongComplex value = a.back(), slope = 0., bend = 0.; // bend = p''/2
    long double rounding = std::abs(value);
    for (std::size_t j = a.size() - 1; j-- > 0;)
    {
      bend     = bend * x + slope;
      slope    = slope * x + value;
      value    = value * x + a[j];
      rounding = rounding * std::abs(x) + std::abs(value);
    }
    if (std::abs(value) <= 0.5L * eps * rounding)
      return x;
    const LongComplex g = slope / value, h = g * g - 2.L * bend / value;
    const LongComplex s    = std::sqrt((degree - 1.L) * (degree * h - g * g));
    const LongComplex plus = g + s, minus = g - s;
    const LongComplex steepest = std::abs(plus) > std::abs(minus) ? plus : minus;
    const LongComplex step     = std::abs(steepest) > 0.L
                                     ? degree / steepest
                                     : std::polar(1.L + std::abs(x), static_cast<long double>(iteration)); // off a saddle
    if (x == x - step)
      return x;
    x -= iteration % 10 == 0 ? 0.618L * step : step; // a shorter step breaks the rare cycles
  }
  return x;
}

} // namespace

std::vector<LongComplex> polynomial_roots(std::vector<LongComplex> coefficients)
{
  while (!coefficients.empty() && coefficients.back() == 0.L)
    coefficients.pop_back();
  std::vector<LongComplex> roots, rest = coefficients;
  while (rest.size() > 1)
  {
    const LongComplex root  = laguerre(rest, 0.L);
    LongComplex       carry = rest.back();
    rest.pop_back();
    for (std::size_t j = rest.size(); j-- > 0;)
    {
      const LongComplex next = rest[j] + root * carry;
      rest[j]                = carry;
      carry                  = next;
    }
    roots.push_back(laguerre(coefficients, root));
  }
  return roots;
}

} // namespace gestell::coupling
