#pragma once

#include <Eigen/SparseCore>

#include <utility>

namespace gestell::fem
{

/// Eigen's sparse matrix with a move constructor: version 3.4 copies instead, a GiB each time for a large frame.
class SparseMatrix : public Eigen::SparseMatrix<double>
{
public:
  using Base = Eigen::SparseMatrix<double>;
  using Base::Base;
  using Base::operator=;

  SparseMatrix()                                = default;
  SparseMatrix(const SparseMatrix &)            = default;
  SparseMatrix &operator=(const SparseMatrix &) = default;
  SparseMatrix(SparseMatrix &&other) noexcept { swap(other); }
  SparseMatrix(Base &&other) noexcept { swap(other); }
  SparseMatrix &operator=(SparseMatrix &&other) noexcept
  {
    swap(other);
    return *this;
  }
  SparseMatrix &operator=(Base &&other) noexcept
  {
    swap(other);
    return *this;
  }
};

} // namespace gestell::fem
