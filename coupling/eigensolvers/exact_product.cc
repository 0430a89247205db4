// Compiled without fused multiply-add: each sum below must be rounded as written.

#include "coupling/eigensolvers/exact_product.h"

#include <algorithm>
#include <cassert>

#if defined(__FMA__)
#include <immintrin.h>
#endif

namespace gestell::coupling
{

namespace
{

constexpr int lanes = 8; ///< columns that travel together: a cache line of doubles
using Lanes         = Eigen::Array<double, lanes, 1>;
using Rows          = Eigen::Array<double, lanes, Eigen::Dynamic>;

#if defined(__FMA__)

/// Rounding error of the product a b.
inline Lanes lost_by_product(double a, const Lanes &b, const Lanes &product)
{
  Lanes lost;
  for (int i = 0; i < lanes; i += 4)
    _mm256_storeu_pd(lost.data() + i, _mm256_fmsub_pd(_mm256_set1_pd(a), _mm256_loadu_pd(b.data() + i),
                                                      _mm256_loadu_pd(product.data() + i)));
  return lost;
}

#else

/// The upper half of the digits of x (Veltkamp).
template <typename T>
T upper_half(const T &x)
{
  const T scaled = 134217729. * x; // 2^27 + 1
  return scaled - (scaled - x);
}

/// Rounding error of the product a b (Dekker).
inline Lanes lost_by_product(double a, const Lanes &b, const Lanes &product)
{
  const double a_upper = upper_half(a), a_lower = a - a_upper;
  const Lanes  b_upper = upper_half(b), b_lower = b - b_upper;
  return a_lower * b_lower - (((product - a_upper * b_upper) - a_lower * b_upper) - a_upper * b_lower);
}

#endif

} // namespace

void exact_product(const Eigen::Ref<const Eigen::SparseMatrix<double>> &A, const Eigen::Ref<const Eigen::MatrixXd> &X,
                   Eigen::Ref<Eigen::MatrixXd> Y)
{
  assert(A.isCompressed() && A.rows() == X.rows() && A.cols() == Y.rows() && X.cols() == Y.cols());
  const int    *start = A.outerIndexPtr(), *row = A.innerIndexPtr();
  const double *a = A.valuePtr();
  Rows          x(lanes, A.rows()); // row i of X: eight columns, contiguous
  for (Eigen::Index first = 0; first < X.cols(); first += lanes)
  {
    const auto width = std::min<Eigen::Index>(lanes, X.cols() - first);
    x.setZero();
    x.topRows(width) = X.middleCols(first, width).transpose();
    for (Eigen::Index j = 0; j < A.cols(); ++j)
    {
      Lanes sum = Lanes::Zero(), lost = Lanes::Zero();
      sum.head(width) = Y.row(j).segment(first, width).transpose();
      for (int k = start[j]; k < start[j + 1]; ++k)
      {
        const Lanes b       = x.col(row[k]);
        const Lanes product = a[k] * b;
        const Lanes next    = sum + product; // and what it loses, after Knuth
        const Lanes part    = next - sum;
        lost += ((sum - (next - part)) + (product - part)) + lost_by_product(a[k], b, product);
        sum = next;
      }
      const Lanes whole              = sum + lost;
      Y.row(j).segment(first, width) = whole.head(width).transpose();
    }
  }
}

Eigen::MatrixXd exact_product(const Eigen::SparseMatrix<double> &A, const Eigen::Ref<const Eigen::MatrixXd> &X)
{
  Eigen::MatrixXd Y = Eigen::MatrixXd::Zero(A.cols(), X.cols());
  exact_product(A, X, Y);
  return Y;
}

} // namespace gestell::coupling
