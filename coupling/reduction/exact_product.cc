// Compiled without fused products: each of the sums below is meant to be rounded where it stands.

#include "coupling/reduction/exact_product.h"

#include <algorithm>
#include <cassert>

namespace gestell::coupling
{

namespace
{

constexpr int lanes = 8; // columns that travel together
using Lanes         = Eigen::Array<double, lanes, 1>;
using Rows          = Eigen::Array<double, lanes, Eigen::Dynamic>;

/// The upper half of the digits of x (Veltkamp).
template <typename T>
T upper_half(const T &x)
{
  const T scaled = 134217729. * x; // 2^27 + 1
  return scaled - (scaled - x);
}

} // namespace

Eigen::MatrixXd exact_product(const Eigen::SparseMatrix<double> &A, const Eigen::Ref<const Eigen::MatrixXd> &X)
{
  assert(A.isCompressed() && A.cols() == X.rows());
  const auto      n     = A.cols();
  const int      *start = A.outerIndexPtr(), *row = A.innerIndexPtr();
  const double   *a = A.valuePtr();
  Eigen::MatrixXd Y(n, X.cols());
  Rows            x(lanes, n); // row i of X, eight columns of it, lies together
  for (Eigen::Index first = 0; first < X.cols(); first += lanes)
  {
    const auto width = std::min<Eigen::Index>(lanes, X.cols() - first);
    x.setZero();
    x.topRows(width) = X.middleCols(first, width).transpose();
    for (Eigen::Index j = 0; j < n; ++j)
    {
      Lanes sum = Lanes::Zero(), lost = Lanes::Zero();
      for (int k = start[j]; k < start[j + 1]; ++k)
      {
        const double a_upper = upper_half(a[k]), a_lower = a[k] - a_upper;
        const Lanes  b = x.col(row[k]), b_upper = upper_half(b), b_lower = b - b_upper;
        const Lanes  product = a[k] * b; // and what it loses, after Dekker
        const Lanes  of_product =
            a_lower * b_lower - (((product - a_upper * b_upper) - a_lower * b_upper) - a_upper * b_lower);
        const Lanes next = sum + product; // and what it loses, after Knuth
        const Lanes part = next - sum;
        lost += ((sum - (next - part)) + (product - part)) + of_product;
        sum = next;
      }
      const Lanes whole              = sum + lost;
      Y.row(j).segment(first, width) = whole.head(width).transpose();
    }
  }
  return Y;
}

} // namespace gestell::coupling
