#include "coupling/integration/backward_differences.h"

#include <algorithm>

namespace gestell::coupling
{

void BackwardDifferences::resize(Eigen::Index size)
{
  D_.setZero(size, highest + 1);
}

void BackwardDifferences::start(const Eigen::VectorXd &oldest, const Eigen::VectorXd &middle,
                                const Eigen::VectorXd &newest)
{
  D_.col(0) = newest;
  D_.col(1) = newest - middle;
  D_.col(2) = newest - 2. * middle + oldest;
  known_    = 2;
}

void BackwardDifferences::predict(int order, Eigen::VectorXd &z) const
{
  z = D_.col(0) + D_.col(1);
  for (int j = 2; j <= order; ++j)
    z += D_.col(j);
}

void BackwardDifferences::history(int order, Eigen::VectorXd &z) const
{
  z = D_.col(0);
  for (int j = 1; j < order; ++j)
    z += (1. - bdf_gamma(j) / bdf_gamma(order)) * D_.col(j);
}

void BackwardDifferences::at(double s, int degree, Eigen::Index first, Eigen::Ref<Eigen::VectorXd> x) const
{
  x             = D_.col(0).segment(first, x.size());
  double weight = 1.;
  for (int j = 1; j <= degree; ++j)
  {
    weight *= (s + j - 1) / j;
    x += weight * D_.col(j).segment(first, x.size());
  }
}

void BackwardDifferences::push(int order, const Eigen::VectorXd &difference)
{
  const bool beyond = known_ > order;
  if (beyond)
    D_.col(order + 2) = difference - D_.col(order + 1);
  D_.col(order + 1) = difference;
  for (int j = order; j >= 0; --j)
    D_.col(j) += D_.col(j + 1);
  known_ = order + (beyond ? 2 : 1);
}

/**
 * New differences of order m from the values at s = 0, -ratio, -2 ratio, ...:
 *
 *     D'_m = sum_{j>=m} T_jm D_j,   T_jm = sum_{i=0..m} (-1)^i (m over i) c_j(-i ratio),   c_j(s) = s (s + 1) .. / j!,
 *
 * as an m-th difference of a polynomial of lower degree j < m is zero.  So the columns can be replaced in place.
 */
void BackwardDifferences::rescale(double ratio, int degree)
{
  std::array<std::array<double, highest + 1>, highest + 1> T{};
  for (int m = 1; m <= degree; ++m)
  {
    double binomial = 1.;
    for (int i = 0; i <= m; ++i)
    {
      double c = 1.;
      for (int j = 1; j <= degree; ++j)
      {
        c *= (-i * ratio + j - 1) / j;
        T[j][m] += binomial * c;
      }
      binomial *= -static_cast<double>(m - i) / (i + 1);
    }
  }
  for (int m = 1; m <= degree; ++m)
  {
    D_.col(m) *= T[m][m];
    for (int j = m + 1; j <= degree; ++j)
      D_.col(m) += T[j][m] * D_.col(j);
  }
  known_ = degree;
}

} // namespace gestell::coupling
