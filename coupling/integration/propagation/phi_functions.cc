#include "coupling/integration/propagation/modal_blocks.h"

#include <algorithm>
#include <cmath>

namespace gestell::coupling
{

namespace
{

/// A complex number with the plain product: std::complex checks every one for infinities.
struct Complex
{
  double re, im;
};
inline Complex operator*(const Complex &a, const Complex &b)
{
  return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}
inline Complex operator+(const Complex &a, double b)
{
  return {a.re + b, a.im};
}
inline Complex operator+(const Complex &a, const Complex &b)
{
  return {a.re + b.re, a.im + b.im};
}
inline Complex scaled(const Complex &a, double factor)
{
  return {a.re * factor, a.im * factor};
}
inline double scaled(double a, double factor)
{
  return a * factor;
}
inline double size(const Complex &a)
{
  return std::max(std::abs(a.re), std::abs(a.im));
}
inline double size(double a)
{
  return std::abs(a);
}
inline Complex exponential(const Complex &z)
{
  const double growth = std::exp(z.re);
  return {growth * std::cos(z.im), growth * std::sin(z.im)};
}
inline double exponential(double z)
{
  return std::exp(z);
}
inline Complex reciprocal(const Complex &z)
{
  const double factor = 1. / (z.re * z.re + z.im * z.im);
  return {z.re * factor, -z.im * factor};
}
inline double reciprocal(double z)
{
  return 1. / z;
}

constexpr double inverse_factorial[] = {1.,        1.,         1. / 2.,     1. / 6.,      1. / 24.,     1. / 120.,
                                        1. / 720., 1. / 5040., 1. / 40320., 1. / 362880., 1. / 3628800.};

/// phi_0 .. phi_k of a number: backwards from a series where |z| is small, forwards elsewhere.
template <typename Number>
void phi_of(const Number &z, int k, Number *phi)
{
  phi[0] = exponential(z);
  if (k == 0)
    return;
  const double magnitude = size(z);
  if (magnitude < 1. + 0.25 * k)
  {
    // phi_k = sum_m z^m/(k + m)!, and phi_i-1 = z phi_i + 1/(i - 1)!
    Number term = z, sum = z;
    term = scaled(z, inverse_factorial[k] / (k + 1));
    sum  = term + inverse_factorial[k];
    for (int m = 2; m < 60; ++m)
    {
      term = scaled(term * z, 1. / (k + m));
      sum  = sum + term;
      if (size(term) < 1e-17 * size(sum))
        break;
    }
    phi[k] = sum;
    for (int i = k; i > 1; --i)
      phi[i - 1] = z * phi[i] + inverse_factorial[i - 1];
    return;
  }
  const Number inverse = reciprocal(z);
  for (int i = 0; i < k; ++i)
    phi[i + 1] = (phi[i] + -inverse_factorial[i]) * inverse;
}

} // namespace

void phi_functions(const ModalBlock &block, double h, int k, Block2 *phi)
{
  constexpr int max_k = 10; // size of the array; collocation of order 8 needs 4
  switch (block.kind)
  {
  case ModalBlock::oscillating:
  {
    Complex values[max_k + 1];
    phi_of(Complex{block.s * h, block.w * h}, k, values);
    for (int i = 0; i <= k; ++i)
      phi[i] = {values[i].re, -values[i].im, values[i].im, values[i].re};
    break;
  }
  case ModalBlock::decaying:
  {
    double first[max_k + 1], second[max_k + 1];
    phi_of(block.s * h, k, first);
    phi_of(block.w * h, k, second);
    for (int i = 0; i <= k; ++i)
      phi[i] = {first[i], 0., 0., second[i]};
    break;
  }
  case ModalBlock::free:
  {
    double factorial = 1.;
    for (int i = 0; i <= k; ++i)
    {
      factorial *= i > 0 ? i : 1.;
      phi[i] = {1. / factorial, h / (factorial * (i + 1)), 0., 1. / factorial};
    }
    break;
  }
  }
}

} // namespace gestell::coupling
