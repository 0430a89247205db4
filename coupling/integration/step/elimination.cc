#include "coupling/integration/step/elimination.h"

#include <algorithm>

namespace gestell::coupling
{

Elimination::Elimination(const Eigen::SparseMatrix<double> &K, const int *rows, const int *columns)
    : pivots_(std::size_t(K.cols())), pivot_(pivots_.size()), inverse_(pivots_.size()), y_(pivots_.size())
{
  const std::size_t n = pivots_.size();
  std::vector<int>  pivot_of_row(n);
  for (std::size_t k = 0; k < n; ++k)
    pivot_of_row[std::size_t(rows[k])] = int(k);

  std::vector<std::vector<int>> of_pivot(n); // columns with an entry in row k of U
  std::vector<char>             filled(n);
  for (std::size_t j = 0; j < n; ++j)
  {
    std::fill(filled.begin(), filled.end(), 0);
    filled[j] = 1;
    for (Eigen::SparseMatrix<double>::InnerIterator it(K, columns[j]); it; ++it)
      filled[std::size_t(pivot_of_row[std::size_t(it.row())])] = 1;
    Pivot &pivot = pivots_[j];
    pivot        = {rows[j], columns[j], int(rows_.size()), 0, 0, 0};
    for (std::size_t i = 0; i < n; ++i)
    {
      if (!filled[i])
        continue;
      if (i == j)
        pivot.diagonal = int(rows_.size());
      rows_.push_back(int(i));
      if (i >= j)
        continue;
      of_pivot[i].push_back(int(j));
      for (int l = pivots_[i].diagonal + 1; l < pivots_[i].end; ++l)
        filled[std::size_t(rows_[std::size_t(l)])] = 1;
    }
    pivot.end = int(rows_.size());
  }
  a_.resize(rows_.size());
  list_work(of_pivot);
  place_.resize(std::size_t(K.nonZeros()));
  for (std::size_t j = 0; j < n; ++j)
    for (int e = K.outerIndexPtr()[columns[j]]; e < K.outerIndexPtr()[columns[j] + 1]; ++e)
      place_[std::size_t(e)] = position(pivot_of_row[std::size_t(K.innerIndexPtr()[e])], int(j));
}

void Elimination::list_work(const std::vector<std::vector<int>> &columns)
{
  for (std::size_t k = 0; k < pivots_.size(); ++k)
  {
    Pivot &pivot = pivots_[k];
    for (const int j : columns[k])
      for (int l = pivot.diagonal + 1; l < pivot.end; ++l)
        products_.push_back({l, position(int(k), j), position(rows_[std::size_t(l)], j)});
    pivot.last = int(products_.size());
    for (int l = pivot.diagonal + 1; l < pivot.end; ++l)
      forward_.push_back({l, int(k), rows_[std::size_t(l)]});
  }
  for (std::size_t k = pivots_.size(); k-- > 0;)
    for (int u = pivots_[k].begin; u < pivots_[k].diagonal; ++u)
      backward_.push_back({u, int(k), rows_[std::size_t(u)]});
}

int Elimination::position(int row, int column) const
{
  const Pivot &pivot = pivots_[std::size_t(column)];
  const auto   first = rows_.begin() + pivot.begin, last = rows_.begin() + pivot.end;
  return int(std::lower_bound(first, last, row) - rows_.begin());
}

void Elimination::factorise()
{
  double        *a = a_.data();
  const Product *p = products_.data();
  for (std::size_t k = 0; k < pivots_.size(); ++k)
  {
    const Pivot &pivot   = pivots_[k];
    const double inverse = 1. / a[pivot.diagonal];
    pivot_[k]            = a[pivot.diagonal];
    inverse_[k]          = inverse;
    for (int l = pivot.diagonal + 1; l < pivot.end; ++l)
      a[l] *= inverse;
    for (const Product *last = products_.data() + pivot.last; p != last; ++p)
      a[p->target] -= a[p->l] * a[p->u];
  }
  for (const Substitution &s : backward_)
    a[s.entry] *= inverse_[std::size_t(s.to)];
}

void Elimination::solve_in_place(Eigen::VectorXd &x)
{
  const double *a = a_.data();
  double       *y = y_.data();
  for (std::size_t k = 0; k < pivots_.size(); ++k)
    y[k] = x[pivots_[k].row];
  for (const Substitution &s : forward_)
    y[s.to] -= a[s.entry] * y[s.from];
  for (std::size_t k = 0; k < pivots_.size(); ++k)
    y[k] *= inverse_[k];
  for (const Substitution &s : backward_)
    y[s.to] -= a[s.entry] * y[s.from];
  for (std::size_t k = 0; k < pivots_.size(); ++k)
    x[pivots_[k].column] = y[k];
}

} // namespace gestell::coupling
