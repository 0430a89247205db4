#pragma once

#include <Eigen/Core>

namespace gestell::coupling
{

/**
 * A small dense matrix [rows x cols] for products in every time step, which a general product starts too slowly for.
 * Its rows are padded with zeros to packets of four numbers; the sums of a few packets remain in registers.
 */
class PackedMatrix
{
public:
  PackedMatrix() = default;
  explicit PackedMatrix(const Eigen::MatrixXd &A)
      : rows_(A.rows()), packed_(Eigen::MatrixXd::Zero(padded(A.rows()), A.cols()))
  {
    packed_.topRows(rows_) = A;
  }

  Eigen::Index rows() const { return rows_; }
  Eigen::Index cols() const { return packed_.cols(); }
  bool         is_empty() const { return packed_.size() == 0; }

  /// Length of a result: `rows` up to a multiple of four.
  static Eigen::Index padded(Eigen::Index rows) { return (rows + 3) / 4 * 4; }

  /// y [padded(rows)] += factor A x
  void add_product(const double *x, double *y, double factor = 1.) const { add_packets(packed_.rows(), x, y, factor); }

  /// y [rows] += factor A x
  void add_product_within(const double *x, double *y, double factor = 1.) const
  {
    const Eigen::Index whole = rows_ / 4 * 4;
    add_packets(whole, x, y, factor);
    if (whole == rows_)
      return;
    Packet last = Packet::Zero();
    add_block<1>(whole, x, last.data(), factor);
    for (Eigen::Index i = whole; i < rows_; ++i)
      y[i] += last[i - whole];
  }

  /// y [cols] += factor A^T x,  x [rows]
  void add_transposed_product(const double *x, double *y, double factor = 1.) const
  {
    Eigen::Index j = 0;
    for (; j + 8 <= cols(); j += 8)
      add_columns<8>(j, x, y + j, factor);
    for (; j + 4 <= cols(); j += 4)
      add_columns<4>(j, x, y + j, factor);
    for (; j < cols(); ++j)
      add_columns<1>(j, x, y + j, factor);
  }

private:
  using Packet = Eigen::Array<double, 4, 1>;

  void add_packets(Eigen::Index rows, const double *x, double *y, double factor) const
  {
    Eigen::Index i = 0;
    for (; i + 12 <= rows; i += 12)
      add_block<3>(i, x, y + i, factor);
    for (; i < rows; i += 4)
      add_block<1>(i, x, y + i, factor);
  }

  /// n packets of rows from `first` on.  Two sums each: an addition waits for the one before it.
  template <int n>
  void add_block(Eigen::Index first, const double *x, double *y, double factor) const
  {
    using In                  = Eigen::Map<const Packet>;
    using Out                 = Eigen::Map<Packet>;
    const Eigen::Index stride = packed_.rows(), columns = packed_.cols();
    const double      *A = packed_.data() + first;
    Packet             even[n], odd[n];
    for (int p = 0; p < n; ++p)
      even[p].setZero(), odd[p].setZero();
    Eigen::Index j = 0;
    for (; j + 1 < columns; j += 2, A += 2 * stride)
      for (int p = 0; p < n; ++p)
      {
        even[p] += In(A + 4 * p) * x[j];
        odd[p] += In(A + stride + 4 * p) * x[j + 1];
      }
    for (int p = 0; p < n && j < columns; ++p)
      even[p] += In(A + 4 * p) * x[j];
    for (int p = 0; p < n; ++p)
      Out(y + 4 * p) += factor * (even[p] + odd[p]);
  }

  /// n columns from `first` on.  A packet of x is read once for all of them.
  template <int n>
  void add_columns(Eigen::Index first, const double *x, double *y, double factor) const
  {
    using In                  = Eigen::Map<const Packet>;
    const Eigen::Index stride = packed_.rows(), whole = rows_ / 4 * 4;
    const double      *A = packed_.data() + stride * first;
    Packet             sum[n];
    for (int c = 0; c < n; ++c)
      sum[c].setZero();
    for (Eigen::Index i = 0; i < whole; i += 4)
      for (int c = 0; c < n; ++c)
        sum[c] += In(A + stride * c + i) * In(x + i);
    if (whole < rows_)
    {
      Packet last = Packet::Zero();
      for (Eigen::Index i = whole; i < rows_; ++i)
        last[i - whole] = x[i];
      for (int c = 0; c < n; ++c)
        sum[c] += In(A + stride * c + whole) * last;
    }
    for (int c = 0; c < n; ++c)
      y[c] += factor * sum[c].sum();
  }

  Eigen::Index    rows_ = 0;
  Eigen::MatrixXd packed_;
};

} // namespace gestell::coupling
