#include "coupling/reduction/matrix_rows.h"

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
fem::CompressedRows rows_for(const SparseMatrix &A, const RowPlan &plan, int rank)
{
  fem::CompressedRows                 rows;
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

fem::CompressedRows dealt_out(const fem::Ranks &ranks, const SparseMatrix *A, const RowPlan &plan)
{
  if (!ranks.first())
  {
    fem::CompressedRows rows;
    rows.begin  = ranks.receive<int>(0);
    rows.column = ranks.receive<int>(0);
    rows.value  = ranks.receive<double>(0);
    return rows;
  }
  for (int other = 1; other < ranks.size(); ++other)
  {
    const fem::CompressedRows rows = rows_for(*A, plan, other);
    ranks.send(rows.begin, other);
    ranks.send(rows.column, other);
    ranks.send(rows.value, other);
  }
  return rows_for(*A, plan, 0);
}

SparseMatrix collected(const fem::Ranks &ranks, const fem::CompressedRows &own, const RowPlan &plan)
{
  if (!ranks.first())
  {
    ranks.send(own.begin, 0);
    ranks.send(own.column, 0);
    ranks.send(own.value, 0);
    return {};
  }
  std::vector<std::vector<int>> begin(ranks.size());
  begin[0] = own.begin;
  for (int other = 1; other < ranks.size(); ++other)
    begin[other] = ranks.receive<int>(other);

  const int    n = int(plan.row_of.size());
  SparseMatrix whole(n, n);
  int         *outer = whole.outerIndexPtr();
  for (int rank = 0; rank < ranks.size(); ++rank)
    for (int i = plan.begin[rank]; i < plan.begin[rank + 1]; ++i)
      outer[plan.coordinate_of[i] + 1] = begin[rank][i - plan.begin[rank] + 1] - begin[rank][i - plan.begin[rank]];
  for (int i = 0; i < n; ++i)
    outer[i + 1] += outer[i];
  whole.resizeNonZeros(outer[n]);

  std::vector<std::pair<int, double>> entries;
  for (int rank = 0; rank < ranks.size(); ++rank)
  {
    const std::vector<int>    received = rank > 0 ? ranks.receive<int>(rank) : std::vector<int>();
    const std::vector<double> values   = rank > 0 ? ranks.receive<double>(rank) : std::vector<double>();
    const auto               &column   = rank > 0 ? received : own.column;
    const auto               &value    = rank > 0 ? values : own.value;
    for (int i = plan.begin[rank]; i < plan.begin[rank + 1]; ++i)
    {
      const int local = i - plan.begin[rank];
      entries.clear();
      for (int k = begin[rank][local]; k < begin[rank][local + 1]; ++k)
        entries.emplace_back(plan.coordinate_of[column[k]], value[k]);
      std::sort(entries.begin(), entries.end());
      int at = outer[plan.coordinate_of[i]];
      for (const auto &[coordinate, entry] : entries)
      {
        whole.innerIndexPtr()[at] = coordinate;
        whole.valuePtr()[at++]    = entry;
      }
    }
  }
  return whole;
}

fem::CompressedRows own_rows(Mat A)
{
  fem::CompressedRows rows;
  for_each_own_row(A, "own_rows",
                   [&](PetscInt, PetscInt count, const PetscInt *columns, const PetscScalar *values)
                   {
                     rows.column.insert(rows.column.end(), columns, columns + count);
                     rows.value.insert(rows.value.end(), values, values + count);
                     rows.begin.push_back(int(rows.column.size()));
                   });
  return rows;
}

fem::CompressedRows sum(const fem::CompressedRows &A, const fem::CompressedRows &B)
{
  fem::CompressedRows result;
  for (int i = 0; i < A.n_rows(); ++i)
  {
    int a = A.begin[i], b = B.begin[i];
    while (a < A.begin[i + 1] || b < B.begin[i + 1])
    {
      const bool of_A = b == B.begin[i + 1] || (a < A.begin[i + 1] && A.column[a] <= B.column[b]);
      const bool of_B = a == A.begin[i + 1] || (b < B.begin[i + 1] && B.column[b] <= A.column[a]);
      result.column.push_back(of_A ? A.column[a] : B.column[b]);
      result.value.push_back((of_A ? A.value[a] : 0.) + (of_B ? B.value[b] : 0.));
      a += of_A;
      b += of_B;
    }
    result.begin.push_back(int(result.column.size()));
  }
  return result;
}

PetscOwned<Mat> shared_matrix(const fem::CompressedRows &rows, int n)
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
