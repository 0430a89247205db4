#include "coupling/integration/bdf/backward_differences.h"

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

namespace
{
/// 1 - gamma_j / gamma_k
template <int order>
constexpr std::array<double, order + 1> history_weights()
{
  std::array<double, order + 1> weights{};
  for (int j = 0; j <= order; ++j)
    weights[j] = 1. - bdf_gamma(j) / bdf_gamma(order);
  return weights;
}

/// Loops over all components with the order known to the compiler.
template <int order>
void combine(const Eigen::MatrixXd &D, double *__restrict predicted, double *__restrict history)
{
  constexpr auto     weights = history_weights<order>();
  const Eigen::Index n       = D.rows();
  const double *__restrict d = D.data();
  for (Eigen::Index i = 0; i < n; ++i)
  {
    double p = d[i], h = d[i];
    for (int j = 1; j <= order; ++j)
    {
      p += d[j * n + i];
      h += weights[j] * d[j * n + i];
    }
    predicted[i] = p;
    history[i]   = h;
  }
}

/// Processes `lanes` components at once: the compiler cannot know that columns do not overlap.
template <int order, int lanes>
void append_lanes(double *d, Eigen::Index n, const double *difference)
{
  using Lanes  = Eigen::Array<double, lanes, 1>;
  using Column = Eigen::Map<Lanes>;
  Lanes  sum   = Eigen::Map<const Lanes>(difference);
  Column beyond(d + (order + 1) * n);
  Column(d + (order + 2) * n) = sum - beyond;
  beyond                      = sum;
  for (int j = order; j >= 0; --j)
  {
    Column column(d + j * n);
    sum += column;
    column = sum;
  }
}

template <int order>
void append(Eigen::MatrixXd &D, const double *difference)
{
  constexpr int      lanes = 8;
  const Eigen::Index n     = D.rows();
  Eigen::Index       i     = 0;
  for (; i + lanes <= n; i += lanes)
    append_lanes<order, lanes>(D.data() + i, n, difference + i);
  for (; i < n; ++i)
    append_lanes<order, 1>(D.data() + i, n, difference + i);
}

} // namespace

void BackwardDifferences::predict(int order, Eigen::VectorXd &predicted, Eigen::VectorXd &history) const
{
  constexpr decltype(&combine<1>) combinations[] = {combine<1>, combine<2>, combine<3>,
                                                    combine<4>, combine<5>, combine<6>};
  combinations[order - 1](D_, predicted.data(), history.data());
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
  constexpr decltype(&append<1>) appends[] = {append<1>, append<2>, append<3>, append<4>, append<5>, append<6>};
  appends[order - 1](D_, difference.data());
  known_ = order + (known_ > order ? 2 : 1); // higher ones depend on an unknown difference
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
