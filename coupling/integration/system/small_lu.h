#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>
#include <vector>

namespace gestell::coupling
{

/// LU factors of a small matrix with partial pivoting; nothing allocates unless resize() grows.  Zeros, as in rows of
/// idle elements, are skipped.
class SmallLu
{
public:
  void resize(int n)
  {
    a_.setZero(n, n);
    row_size_.setZero(n);
    pivot_.assign(n, 0);
    idle_.assign(n, 0);
  }
  /// To be filled, then factorised.
  Eigen::MatrixXd &matrix() { return a_; }
  /// A matrix of n <= the size of resize(), until the next call: its numbers, column by column.
  double *use(int n)
  {
    pivot_.resize(n);
    idle_.resize(n);
    return a_.data();
  }

  /// Factorises.  False: singular, because a pivot is within the rounding error of its row and of the products that
  /// elimination subtracted from it; unknowns of other units, such as states of drives, may make the row arbitrarily
  /// large. If nothing sticks and `redundant` rows are impossible, only a zero pivot is singular.
  bool factorise(bool redundant = true)
  {
    return with_size([&](const auto n) { return factorise_sized(n, redundant); });
  }

  /// Smallest pivot of the last factorisation; negative if rows were interchanged.  If it is above 1/4 for I - S dp,
  /// the solution is at most about four times as large as the motion; it can be larger near the pole of a force that
  /// falls with the motion.
  double least_pivot() const { return least_; }

  /// If factorise() found the matrix singular: a column that depends on those before it.
  int failed() const { return failed_; }

  template <typename Vector>
  void solve_in_place(Vector &&x) const
  {
    with_size(
        [&](const auto n)
        {
          const double *a = a_.data();
          if (interchanged_)
            for (int k = 0; k < n; ++k)
              std::swap(x[k], x[pivot_[k]]);
          for (int k = 0; k < n; ++k)
            for (int i = k + 1; !idle_[k] && i < n; ++i)
              x[i] -= a[i + n * k] * x[k];
          for (int k = n - 1; k >= 0; --k)
          {
            x[k] *= a[k + n * k];
            for (int i = 0; i < k; ++i)
              x[i] -= a[i + n * k] * x[k];
          }
          return true;
        });
  }

  template <typename Archive>
  void exchange(Archive &archive)
  {
    archive(a_, row_size_, pivot_, idle_, interchanged_, least_, failed_);
  }

private:
  /// Calls `work` with the number of unknowns as a constant if it is small, so that the compiler unrolls all loops.
  template <class Work>
  bool with_size(const Work &work) const
  {
    switch (pivot_.size())
    {
    case 1:
      return work(std::integral_constant<int, 1>{});
    case 2:
      return work(std::integral_constant<int, 2>{});
    case 3:
      return work(std::integral_constant<int, 3>{});
    case 4:
      return work(std::integral_constant<int, 4>{});
    case 5:
      return work(std::integral_constant<int, 5>{});
    case 6:
      return work(std::integral_constant<int, 6>{});
    default:
      return work(static_cast<int>(pivot_.size()));
    }
  }

  template <class Size>
  bool factorise_sized(const Size n, bool redundant)
  {
    constexpr double rounding = 1e-14;
    double          *a        = a_.data();
    least_                    = n > 0 ? a[0] : 1.;
    interchanged_             = false;
    row_size_.setZero();
    for (int j = 0; redundant && j < n; ++j)
      for (int i = 0; i < n; ++i)
        row_size_[i] = std::max(row_size_[i], std::abs(a[i + n * j]));
    for (int k = 0; k < n; ++k)
    {
      int    pivot   = k;
      double largest = std::abs(a[k + n * k]), below = 0.;
      for (int i = k + 1; i < n; ++i)
      {
        const double size = std::abs(a[i + n * k]);
        below             = std::max(below, size);
        if (size > largest)
          largest = size, pivot = i;
      }
      pivot_[k] = pivot;
      interchanged_ |= pivot != k;
      idle_[k] = below == 0.;
      failed_  = k;
      if (!(largest > rounding * row_size_[pivot] || largest > rounding * terms(pivot, k)) || !std::isfinite(largest))
        return false;
      least_ = std::min(least_, pivot == k ? a[k + n * k] : -1.);
      if (pivot != k)
      {
        std::swap(row_size_[k], row_size_[pivot]);
        for (int j = 0; j < n; ++j)
          std::swap(a[k + n * j], a[pivot + n * j]);
      }
      const double inverse = a[k + n * k] = 1. / a[k + n * k];
      if (idle_[k])
        continue;
      for (int i = k + 1; i < n; ++i)
        a[i + n * k] *= inverse;
      for (int j = k + 1; j < n; ++j)
        if (const double factor = a[k + n * j]; factor != 0.)
          for (int i = k + 1; i < n; ++i)
            a[i + n * j] -= a[i + n * k] * factor;
    }
    return true;
  }

  /// Sum of the magnitudes that elimination has subtracted from an entry so far, in arbitrary units.
  double terms(int row, int column) const
  {
    const auto n   = Eigen::Index(pivot_.size());
    double     sum = 0.;
    for (int m = 0; m < column; ++m)
      sum += std::abs(a_.data()[row + n * m] * a_.data()[m + n * column]);
    return sum;
  }

  Eigen::MatrixXd   a_;
  Eigen::VectorXd   row_size_; ///< largest entry of each row before elimination
  std::vector<int>  pivot_;
  std::vector<char> idle_; ///< columns with nothing below the pivot
  bool              interchanged_ = false;
  double            least_        = 1.;
  int               failed_       = 0;
};

} // namespace gestell::coupling
