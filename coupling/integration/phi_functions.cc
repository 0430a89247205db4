#include "coupling/integration/modal_blocks.h"

#include <cmath>
#include <complex>

namespace gestell::coupling
{

namespace
{

constexpr int max_k = 10;

/// phi_0 .. phi_k of a number: backwards from a series where |z| is small, forwards elsewhere.
template <typename Number>
void phi_of(const Number &z, int k, Number *phi)
{
  double factorial[max_k + 1] = {1.};
  for (int i = 1; i <= k; ++i)
    factorial[i] = factorial[i - 1] * i;
  const double size = std::abs(z);
  if (size < 1. + 0.5 * k)
  {
    // phi_k = sum_m z^m/(k + m)!, and phi_i-1 = z phi_i + 1/(i - 1)!
    Number term = Number(1. / factorial[k]), sum = term;
    for (int m = 1; m < 60; ++m)
    {
      term *= z / double(k + m);
      sum += term;
      if (std::abs(term) < 1e-18 * std::abs(sum))
        break;
    }
    phi[k] = sum;
    for (int i = k; i > 1; --i)
      phi[i - 1] = z * phi[i] + 1. / factorial[i - 1];
    if (k > 0)
      phi[0] = std::exp(z);
    return;
  }
  phi[0] = std::exp(z);
  for (int i = 0; i < k; ++i)
    phi[i + 1] = (phi[i] - 1. / factorial[i]) / z;
}

} // namespace

void phi_functions(const ModalBlock &block, double h, int k, Block2 *phi)
{
  switch (block.kind)
  {
  case ModalBlock::oscillating:
  {
    std::complex<double> values[max_k + 1];
    phi_of(std::complex<double>(block.s * h, block.w * h), k, values);
    for (int i = 0; i <= k; ++i)
      phi[i] = {values[i].real(), -values[i].imag(), values[i].imag(), values[i].real()};
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
