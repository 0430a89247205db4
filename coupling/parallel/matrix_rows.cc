#include "coupling/parallel/matrix_rows.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace gestell::coupling
{

using SparseMatrix = Eigen::SparseMatrix<double>;

RowPlan plan_rows(const std::vector<int> &rank_of, int n_ranks)
{
  const int n = int(rank_of.size());
  RowPlan   plan{std::vector<int>(n_ranks + 1, 0), std::vector<int>(n), std::vector<int>(n)};
  for (const int rank : rank_of)
    ++plan.begin[rank + 1];
  std::partial_sum(plan.begin.begin(), plan.begin.end(), plan.begin.begin());
  std::vector<int> next = plan.begin;
  for (int i = 0; i < n; ++i)
  {
    const int row           = next[rank_of[i]]++;
    plan.row_of[i]          = row;
    plan.coordinate_of[row] = i;
  }
  return plan;
}

namespace
{

/// Rows of A for one rank, columns ascending.
CompressedRows rows_for(const SparseMatrix &A, const RowPlan &plan, int rank)
{
  CompressedRows                      rows;
  std::vector<std::pair<int, double>> entries;
  for (int row = plan.begin[rank]; row < plan.begin[rank + 1]; ++row)
  {
    entries.clear();
    for (SparseMatrix::InnerIterator a(A, plan.coordinate_of[row]); a; ++a)
      entries.emplace_back(plan.row_of[a.row()], a.value());
    std::sort(entries.begin(), entries.end());
    for (const auto &[column, value] : entries)
    {
      rows.column.push_back(column);
      rows.value.push_back(value);
    }
    rows.begin.push_back(int(rows.column.size()));
  }
  return rows;
}

} // namespace

CompressedRows dealt_out(const fem::Ranks &ranks, const SparseMatrix *A, const RowPlan &plan)
{
  if (!ranks.first())
  {
    CompressedRows rows;
    rows.begin  = ranks.receive<int>(0);
    rows.column = ranks.receive<int>(0);
    rows.value  = ranks.receive<double>(0);
    return rows;
  }
  for (int other = 1; other < ranks.size(); ++other)
  {
    const CompressedRows rows = rows_for(*A, plan, other);
    ranks.send(rows.begin, other);
    ranks.send(rows.column, other);
    ranks.send(rows.value, other);
  }
  return rows_for(*A, plan, 0);
}

PetscOwned<Mat> shared_matrix(const CompressedRows &rows, int n)
{
  const int n_rows = rows.n_rows();
  Mat       A      = nullptr;
  require_petsc(MatCreateMPIAIJWithArrays(fem::Ranks::comm(), n_rows, n_rows, n, n, rows.begin.data(),
                                          rows.column.data(), rows.value.data(), &A),
                "shared_matrix");
  MatSetOption(A, MAT_SYMMETRIC, PETSC_TRUE);
  return PetscOwned<Mat>(A);
}

} // namespace gestell::coupling
