#include "coupling/reduction/shared_matrices.h"

#include "coupling/reduction/matrix_graph.h"
#include "fem/petsc_session.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace gestell::coupling
{

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

using SparseMatrix = Eigen::SparseMatrix<double>;

/// Compressed rows of one rank.
struct Rows
{
  std::vector<int>    begin, column;
  std::vector<double> value;
};

/// Rows of A for one rank, columns ascending.
Rows rows_for(const SparseMatrix &A, const RowPlan &plan, int rank)
{
  Rows                                rows;
  std::vector<std::pair<int, double>> entries;
  rows.begin.push_back(0);
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

/// Rank 0 sends every other rank its rows.
Rows dealt_out(const fem::Ranks &ranks, const SparseMatrix *A, const RowPlan &plan)
{
  if (!ranks.first())
  {
    Rows rows;
    rows.begin  = ranks.receive<int>(0);
    rows.column = ranks.receive<int>(0);
    rows.value  = ranks.receive<double>(0);
    return rows;
  }
  for (int other = 1; other < ranks.size(); ++other)
  {
    const Rows rows = rows_for(*A, plan, other);
    ranks.send(rows.begin, other);
    ranks.send(rows.column, other);
    ranks.send(rows.value, other);
  }
  return rows_for(*A, plan, 0);
}

PetscOwned<Mat> shared_matrix(const Rows &rows, int n)
{
  const int n_rows = int(rows.begin.size()) - 1;
  Mat       A      = nullptr;
  require_petsc(MatCreateMPIAIJWithArrays(fem::Ranks::comm(), n_rows, n_rows, n, n, rows.begin.data(),
                                          rows.column.data(), rows.value.data(), &A),
                "SharedMatrices");
  MatSetOption(A, MAT_SYMMETRIC, PETSC_TRUE);
  return PetscOwned<Mat>(A);
}

} // namespace

SharedMatrices::SharedMatrices(const fem::Ranks &ranks, const SparseMatrix *C, const SparseMatrix *M) : ranks_(ranks)
{
  fem::petsc_session();
  RowPlan plan;
  ranks.agree(
      [&]
      {
        if (C)
          plan = plan_rows(MatrixGraph(*C).parts(ranks.size()), ranks.size());
      });
  row_of_ = plan.row_of;
  begin_  = plan.begin;
  begin_.resize(ranks.size() + 1);
  for (int &begin : begin_)
    ranks.broadcast(begin);
  C_ = shared_matrix(dealt_out(ranks, C, plan), n());
  M_ = shared_matrix(dealt_out(ranks, M, plan), n());
}

SharedMatrices::SharedMatrices(const fem::Ranks &ranks, std::vector<int> begin, std::vector<int> row_of,
                               PetscOwned<Mat> C, PetscOwned<Mat> M)
    : ranks_(ranks), begin_(std::move(begin)), row_of_(std::move(row_of)), C_(std::move(C)), M_(std::move(M))
{
}

std::vector<int> SharedMatrices::rows_of(const std::vector<int> *coordinates) const
{
  int count = coordinates ? int(coordinates->size()) : 0;
  ranks_.broadcast(count);
  std::vector<int> rows;
  for (int k = 0; k < count; ++k)
  {
    int row = coordinates ? row_of_[(*coordinates)[k]] : -1;
    ranks_.broadcast(row);
    rows.push_back(row);
  }
  std::sort(rows.begin(), rows.end());
  return rows;
}

PetscOwned<Vec> SharedMatrices::vector() const
{
  Vec x = nullptr;
  require_petsc(MatCreateVecs(C(), &x, nullptr), "SharedMatrices");
  return PetscOwned<Vec>(x);
}

void SharedMatrices::deal_out(const double *on_first, Vec shared) const
{
  std::vector<double> rows(row_of_.size());
  for (std::size_t i = 0; i < row_of_.size(); ++i)
    rows[row_of_[i]] = on_first[i];
  std::vector<int> counts(ranks_.size());
  std::adjacent_difference(begin_.begin() + 1, begin_.end(), counts.begin());
  PetscScalar *own = nullptr;
  require_petsc(VecGetArray(shared, &own), "SharedMatrices");
  MPI_Scatterv(rows.data(), counts.data(), begin_.data(), MPI_DOUBLE, own, counts[ranks_.rank()], MPI_DOUBLE, 0,
               fem::Ranks::comm());
  require_petsc(VecRestoreArray(shared, &own), "SharedMatrices");
}

void SharedMatrices::collect(Vec shared, double *on_first) const
{
  std::vector<double> rows(row_of_.size());
  std::vector<int>    counts(ranks_.size());
  std::adjacent_difference(begin_.begin() + 1, begin_.end(), counts.begin());
  const PetscScalar *own = nullptr;
  require_petsc(VecGetArrayRead(shared, &own), "SharedMatrices");
  MPI_Gatherv(own, counts[ranks_.rank()], MPI_DOUBLE, rows.data(), counts.data(), begin_.data(), MPI_DOUBLE, 0,
              fem::Ranks::comm());
  require_petsc(VecRestoreArrayRead(shared, &own), "SharedMatrices");
  for (std::size_t i = 0; i < row_of_.size(); ++i)
    on_first[i] = rows[row_of_[i]];
}

} // namespace gestell::coupling
