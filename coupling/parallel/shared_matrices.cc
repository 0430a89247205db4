#include "coupling/parallel/shared_matrices.h"

#include "coupling/parallel/matrix_graph.h"
#include "fem/parallel/petsc_session.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace gestell::coupling
{

using SparseMatrix = Eigen::SparseMatrix<double>;

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
