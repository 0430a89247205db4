#include "coupling/integration/stability/characteristic_roots.h"

#include "coupling/integration/system/dense_solvers.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gestell::coupling
{

namespace
{
constexpr long double rounded_terms = 8.L; ///< times that of one product: entries of a step are sums of a few terms
}

LongComplex exponent(const TestOscillator &o)
{
  const long double zeta = o.zeta;
  return static_cast<long double>(o.omega_h) * (-zeta + std::sqrt(LongComplex(zeta * zeta - 1.L)));
}

CharacteristicRoots roots_of_z(const std::vector<LongComplex> &polynomial)
{
  CharacteristicRoots roots{{}, -1.L};
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

/// det is 1 without damping, which as a margin would hide how close |trace| is to its limit between two intervals of
/// growth.  For a double root, such as r = 1 for a motion with a small phase per step, rounding of trace and det splits
/// the roots by its square root, far above its growth: a discriminant of that size is treated as a double root.
CharacteristicRoots roots_of_map(const Eigen::Matrix<long double, 2, 2> &A)
{
  const long double trace = A(0, 0) + A(1, 1), det = A(0, 0) * A(1, 1) - A(0, 1) * A(1, 0);
  const long double discriminant = 0.25L * trace * trace - det;
  const long double rounding     = rounded_terms * std::numeric_limits<long double>::epsilon() *
                               (0.25L * trace * trace + std::abs(A(0, 0) * A(1, 1)) + std::abs(A(0, 1) * A(1, 0)));
  CharacteristicRoots roots{{}, (det > 1.L + 1e-15L ? det : std::abs(trace) - det) - 1.L - 1e-16L};
  if (discriminant < rounding)
  {
    const LongComplex r(0.5L * trace, std::sqrt(std::max(0.L, -discriminant)));
    const long double log_abs = 0.5L * std::log(det);
    roots.all                 = {{r, log_abs}, {std::conj(r), log_abs}};
    return roots;
  }
  const long double large = 0.5L * trace + std::copysign(std::sqrt(discriminant), trace);
  for (const long double r : {large, large != 0.L ? det / large : 0.L})
    roots.all.push_back({r, std::log(std::abs(r))});
  return roots;
}

CharacteristicRoots roots_of_matrix(const Eigen::MatrixXd &A)
{
  constexpr long double rounding = 1e-13L;
  CharacteristicRoots   roots{{}, -std::numeric_limits<long double>::infinity()};
  for (const std::complex<double> &r : A.eigenvalues())
  {
    roots.all.push_back({LongComplex(r.real(), r.imag()), std::log(std::abs(LongComplex(r.real(), r.imag())))});
    roots.margin = std::max(roots.margin, roots.all.back().log_abs - rounding);
  }
  return roots;
}

} // namespace gestell::coupling
