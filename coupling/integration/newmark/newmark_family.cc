#include "coupling/integration/newmark/newmark_family.h"

namespace gestell::coupling
{

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

/// Newmark's family, with E = (1 - alpha_f) r + alpha_f and so on,
///
///     ((1-alpha_m) r + alpha_m) (r-1)^2 + 2 zeta Omega E (1-gamma+gamma r)(r-1)
///       + Omega^2 E [1-gamma+gamma r + (1/2-beta+beta r)(r-1)] = 0,
///
/// becomes with r = (1+z)/(1-z), and times (1-z)^3,
///
///     4 z^2 (1+a z) + 4 zeta Omega z (1+b z)(1+c z) + Omega^2 (1+b z)(1 + c z + d z^2) = 0,
///     a = 1 - 2 alpha_m,  b = 1 - 2 alpha_f,  c = 2 gamma - 1,  d = 4 beta - 2 gamma.
CharacteristicRoots newmark_roots(const NewmarkFamily &f, const TestOscillator &o)
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

} // namespace gestell::coupling
