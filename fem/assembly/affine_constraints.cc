#include "fem/assembly/affine_constraints.h"

#include <deal.II/base/multithread_info.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/sparsity_pattern.h>

#include <algorithm>
#include <cassert>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace gestell::fem
{

struct AffineConstraints::Lines
{
  dealii::AffineConstraints<double> of;
};

namespace
{

/// Threads of deal.II do not survive the fork of a child, which would wait for them without end.  Its loops here are
/// short.
[[maybe_unused]] const bool without_threads = []
{
  dealii::MultithreadInfo::set_thread_limit(1);
  return true;
}();

using Indices = std::vector<dealii::types::global_dof_index>;

/// Entries of a matrix that are taken.
enum class Entries
{
  of_pattern,
  other_than_zero
};

/// Rows and columns of A; the upper triangle is a copy of the lower one, since sums over ties are rounded in the order
/// of rows.
SparseMatrix taken_from(const dealii::SparseMatrix<double> &A, const std::vector<int> &coordinates, Entries entries)
{
  std::vector<int> number(A.m(), -1);
  for (std::size_t i = 0; i < coordinates.size(); ++i)
    number[coordinates[i]] = static_cast<int>(i);
  const int  n                   = static_cast<int>(coordinates.size());
  const auto for_each_below_diag = [&](const auto &visit)
  {
    for (int i = 0; i < n; ++i)
    {
      const unsigned int row   = coordinates[i];
      auto               entry = A.begin(row);
      for (++entry; entry != A.end(row) && entry->column() < row; ++entry) // deal.II stores the diagonal first
        if (const int j = number[entry->column()]; j >= 0 && (entries == Entries::of_pattern || entry->value() != 0.))
          visit(i, j, entry->value());
      visit(i, i, A.diag_element(row));
    }
  };

  SparseMatrix result(n, n);
  for_each_below_diag(
      [begin = result.outerIndexPtr() + 1](int i, int j, double)
      {
        ++begin[i];
        begin[j] += j < i;
      });
  const double count = std::accumulate(result.outerIndexPtr(), result.outerIndexPtr() + n + 1, 0.);
  if (count > std::numeric_limits<int>::max())
    throw std::runtime_error("frame: its matrices have " + std::to_string(count) +
                             " entries, more than can be numbered; use a coarser mesh");
  std::partial_sum(result.outerIndexPtr(), result.outerIndexPtr() + n + 1, result.outerIndexPtr());
  result.resizeNonZeros(result.outerIndexPtr()[n]);
  std::vector<int> next(result.outerIndexPtr(), result.outerIndexPtr() + n);
  const auto       put = [&](int row, int column, double value)
  {
    result.innerIndexPtr()[next[column]] = row;
    result.valuePtr()[next[column]++]    = value;
  };
  for_each_below_diag(
      [&](int i, int j, double value)
      {
        put(j, i, value);
        if (j < i)
          put(i, j, value);
      });
  return result;
}

dealii::FullMatrix<double> full(const Eigen::MatrixXd &A)
{
  return {static_cast<unsigned int>(A.rows()), static_cast<unsigned int>(A.cols()), A.data()}; // symmetric
}

} // namespace

MultipointConstraints::MultipointConstraints(int n_nodes) : held(3 * n_nodes, 0), tie_of(3 * n_nodes, -1) {}

void MultipointConstraints::tie(int displacement, Combination combination)
{
  assert(tie_of[displacement] < 0 && !held[displacement]);
  tie_of[displacement] = static_cast<int>(ties.size());
  ties.push_back(std::move(combination));
}

AffineConstraints::AffineConstraints(const MultipointConstraints &constraints)
    : constraints_(constraints), index_(constraints.held.size() + constraints.measures.size())
{
  const auto &[held, holder, tie_of, ties, measures, n_interface] = constraints_;
  const int  n_displacements = static_cast<int>(held.size()), n_values = static_cast<int>(index_.size());
  const auto is_free = [&](int value) { return value >= n_displacements || (!held[value] && tie_of[value] < 0); };
  // Free displacements, internal DOFs of averaged surfaces, DOFs of interfaces, and what depends on them.
  int n = 0;
  for (int i = 0; i < n_displacements; ++i)
    if (is_free(i))
      index_[i] = n++;
  for (int i = n_displacements + n_interface; i < n_values; ++i)
    index_[i] = n++;
  for (int i = n_displacements; i < n_displacements + n_interface; ++i)
    index_[i] = n++;
  G_.resize(n_displacements, n);
  for (int i = 0; i < n_displacements; ++i)
    if (!is_free(i))
      index_[i] = n++;

  const auto lines = std::make_shared<Lines>();
  for (int i = 0; i < n_displacements; ++i)
    if (!is_free(i))
    {
      lines->of.add_line(index_[i]);
      if (tie_of[i] >= 0)
        for (const auto &[value, weight] : ties[tie_of[i]])
        {
          if (value < n_displacements && tie_of[value] >= tie_of[i]) // else deal.II may follow ties in a circle
            throw std::invalid_argument("constraints: displacement " + std::to_string(i) +
                                        " is tied to itself or to a displacement that is tied later");
          lines->of.add_entry(index_[i], index_[value], weight);
        }
    }
  lines->of.close();
  lines_ = lines;

  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < n_displacements; ++i)
    if (is_free(i))
      entries.emplace_back(i, index_[i], 1.);
    else
      for (const auto &[index, weight] : *lines->of.get_constraint_entries(index_[i]))
        entries.emplace_back(i, index, weight);
  G_.setFromTriplets(entries.begin(), entries.end());
}

Combination AffineConstraints::row(int displacement) const
{
  Combination result;
  for (decltype(G_)::InnerIterator entry(G_, displacement); entry; ++entry)
    result.emplace_back(static_cast<int>(entry.col()), entry.value());
  return result;
}

Eigen::SparseMatrix<double> AffineConstraints::project(const Eigen::SparseMatrix<double> &A) const
{
  const Eigen::SparseMatrix<double> G = G_;
  const Eigen::SparseMatrix<double> P = G.transpose() * Eigen::SparseMatrix<double>(A * G);
  return 0.5 * (P + Eigen::SparseMatrix<double>(P.transpose()));
}

MatrixSums AffineConstraints::sum(const Extent &extent, const std::function<std::vector<int>(int cell)> &nodes,
                                  const std::function<CellMatrices(int cell)> &matrices) const
{
  const dealii::AffineConstraints<double> &lines     = lines_->of;
  const auto                               index_set = [&](const std::vector<int> &of_cell, int first, int count)
  {
    Indices indices;
    for (const int node : of_cell)
      for (int d = first; d < first + count; ++d)
        indices.push_back(index_[3 * node + d]);
    return indices;
  };

  dealii::SparsityPattern pattern; // of C, and of M with zeros between unlike directions
  {
    dealii::DynamicSparsityPattern pairs(n_coordinates() + lines.n_constraints());
    for (const int cell : extent.cells)
      lines.add_entries_local_to_global(index_set(nodes(cell), 0, 3), pairs, false);
    pattern.copy_from(pairs);
  }

  dealii::SparseMatrix<double> C(pattern), M(pattern);
  for (const int cell : extent.cells)
  {
    const std::vector<int> of_cell = nodes(cell);
    const CellMatrices     own     = matrices(cell);
    lines.distribute_local_to_global(full(own.C), index_set(of_cell, 0, 3), C);
    const dealii::FullMatrix<double> own_M = full(own.M);
    for (int d = 0; d < 3; ++d)
      lines.distribute_local_to_global(own_M, index_set(of_cell, d, 1), M);
  }
  return {taken_from(C, extent.coordinates, Entries::of_pattern),
          taken_from(M, extent.coordinates, Entries::other_than_zero)};
}

} // namespace gestell::fem
