#include "apps/peers/native_vectors.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace gestell::peers
{
namespace
{

using Array = Eigen::Map<Eigen::ArrayXd>;

Array of(N_Vector x)
{
  return {N_VGetArrayPointer(x), N_VGetLength(x)};
}

void linear_sum(double a, N_Vector x, double b, N_Vector y, N_Vector z)
{
  of(z) = a * of(x) + b * of(y);
}
void fill(double c, N_Vector z)
{
  of(z).setConstant(c);
}
void product(N_Vector x, N_Vector y, N_Vector z)
{
  of(z) = of(x) * of(y);
}
void quotient(N_Vector x, N_Vector y, N_Vector z)
{
  of(z) = of(x) / of(y);
}
void scale(double c, N_Vector x, N_Vector z)
{
  of(z) = c * of(x);
}
void magnitude(N_Vector x, N_Vector z)
{
  of(z) = of(x).abs();
}
void inverse(N_Vector x, N_Vector z)
{
  of(z) = of(x).inverse();
}
void add_constant(N_Vector x, double b, N_Vector z)
{
  of(z) = of(x) + b;
}
double dot(N_Vector x, N_Vector y)
{
  return (of(x) * of(y)).sum();
}
double largest(N_Vector x)
{
  return of(x).abs().maxCoeff();
}
double smallest(N_Vector x)
{
  return of(x).minCoeff();
}
double weighted_rms(N_Vector x, N_Vector w)
{
  return std::sqrt((of(x) * of(w)).square().sum() / double(N_VGetLength(x)));
}
double weighted_l2(N_Vector x, N_Vector w)
{
  return std::sqrt((of(x) * of(w)).square().sum());
}

/// z = sum c_k x_k, where z may be one of the x_k: piece by piece, in a register or two.
int combination(int n_vectors, double *c, N_Vector *x, N_Vector z)
{
  constexpr Eigen::Index piece = 32;
  Array                  sum   = of(z);
  for (Eigen::Index i = 0; i < sum.size(); i += piece)
  {
    const Eigen::Index                                        n    = std::min(piece, sum.size() - i);
    Eigen::Array<double, Eigen::Dynamic, 1, 0, int(piece), 1> part = c[0] * of(x[0]).segment(i, n);
    for (int k = 1; k < n_vectors; ++k)
      part += c[k] * of(x[k]).segment(i, n);
    sum.segment(i, n) = part;
  }
  return 0;
}

/// z_k = a_k x + y_k.
int scale_add(int n_vectors, double *a, N_Vector x, N_Vector *y, N_Vector *z)
{
  for (int k = 0; k < n_vectors; ++k)
    of(z[k]) = a[k] * of(x) + of(y[k]);
  return 0;
}

} // namespace

void use_native_arithmetic(N_Vector x)
{
  N_Vector_Ops ops         = x->ops;
  ops->nvlinearsum         = linear_sum;
  ops->nvconst             = fill;
  ops->nvprod              = product;
  ops->nvdiv               = quotient;
  ops->nvscale             = scale;
  ops->nvabs               = magnitude;
  ops->nvinv               = inverse;
  ops->nvaddconst          = add_constant;
  ops->nvdotprod           = dot;
  ops->nvmaxnorm           = largest;
  ops->nvmin               = smallest;
  ops->nvwrmsnorm          = weighted_rms;
  ops->nvwl2norm           = weighted_l2;
  ops->nvlinearcombination = combination;
  ops->nvscaleaddmulti     = scale_add;
}

} // namespace gestell::peers
