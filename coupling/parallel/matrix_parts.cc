#include "coupling/parallel/matrix_parts.h"

#include <algorithm>
#include <utility>

namespace gestell::coupling
{

using SparseMatrix = Eigen::SparseMatrix<double>;

namespace
{

/// A(order, order), by columns of ascending rows, with the entries for which keep(row, column) is true.
template <typename Keep>
SparseMatrix part_of(const SparseMatrix &A, const std::vector<int> &order, const Keep &keep)
{
  const int        n = int(order.size());
  std::vector<int> row_of(A.rows(), -1);
  for (int k = 0; k < n; ++k)
    row_of[order[k]] = k;
  const auto along = [&](int k, const auto &visit)
  {
    for (SparseMatrix::InnerIterator a(A, order[k]); a; ++a)
      if (const int row = row_of[a.row()]; row >= 0 && keep(row, k))
        visit(row, a.value());
  };
  Eigen::VectorXi height = Eigen::VectorXi::Zero(n);
  for (int k = 0; k < n; ++k)
    along(k, [&](int, double) { ++height[k]; });
  SparseMatrix part(n, n);
  part.reserve(height);
  std::vector<std::pair<int, double>> column;
  for (int k = 0; k < n; ++k)
  {
    column.clear();
    along(k, [&](int row, double value) { column.emplace_back(row, value); });
    std::sort(column.begin(), column.end());
    for (const auto &[row, value] : column)
      part.insert(row, k) = value;
  }
  part.makeCompressed();
  return part;
}

} // namespace

SparseMatrix lower_part(const SparseMatrix &C, const std::vector<int> &order, int n_columns)
{
  return part_of(C, order, [&](int row, int k) { return row == k || (k < n_columns && row > k); });
}

SparseMatrix additive_part(const SparseMatrix &M, const std::vector<int> &order, int n_own, bool with_border)
{
  return part_of(M, order, [&](int row, int k) { return with_border || row < n_own || k < n_own; });
}

void send(const fem::Ranks &ranks, const SparseMatrix &A, int to)
{
  ranks.send(std::vector<int>(A.outerIndexPtr(), A.outerIndexPtr() + A.cols() + 1), to);
  ranks.send(std::vector<int>(A.innerIndexPtr(), A.innerIndexPtr() + A.nonZeros()), to);
  ranks.send(A.valuePtr(), A.nonZeros(), to);
}

SparseMatrix receive_matrix(const fem::Ranks &ranks)
{
  const auto   begin = ranks.receive<int>(0), rows = ranks.receive<int>(0);
  const int    n = int(begin.size()) - 1;
  SparseMatrix A(n, n);
  A.resizeNonZeros(Eigen::Index(rows.size()));
  std::copy(begin.begin(), begin.end(), A.outerIndexPtr());
  std::copy(rows.begin(), rows.end(), A.innerIndexPtr());
  ranks.receive(A.valuePtr(), A.nonZeros(), 0);
  return A;
}

} // namespace gestell::coupling
