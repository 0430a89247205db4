#include "fem/assembly/affine_constraints.h"

#include <algorithm>
#include <cassert>

namespace gestell::fem
{

MultipointConstraints::MultipointConstraints(int n_nodes) : held(3 * n_nodes, 0), tie_of(3 * n_nodes, -1) {}

void MultipointConstraints::tie(int displacement, Combination combination)
{
  assert(tie_of[displacement] < 0 && !held[displacement]);
  tie_of[displacement] = static_cast<int>(ties.size());
  ties.push_back(std::move(combination));
}

AffineConstraints::AffineConstraints(const MultipointConstraints &constraints)
    : column_(constraints.held.size(), -1), new_column_(constraints.measures.size(), -1), tied_row_(constraints.tie_of),
      tied_(constraints.ties.size())
{
  for (std::size_t i = 0; i < column_.size(); ++i)
    if (tied_row_[i] >= 0)
      tied_[tied_row_[i]] = static_cast<int>(i);
    else if (!constraints.held[i])
      column_[i] = n_coordinates_++;
  n_free_ = n_coordinates_;

  const int n_new = static_cast<int>(new_column_.size());
  for (int k = constraints.n_interface_coordinates; k < n_new; ++k)
    new_column_[k] = n_coordinates_++;
  for (int k = 0; k < constraints.n_interface_coordinates; ++k)
    new_column_[k] = n_coordinates_++;
  n_of_nodes_ = constraints.n_interface_coordinates;

  std::vector<Eigen::Triplet<double>> entries;
  const std::vector<Combination>      ties = closed_ties(constraints.held, constraints.tie_of, constraints.ties);
  for (std::size_t row = 0; row < ties.size(); ++row)
    for (const auto &[value, weight] : ties[row])
    {
      assert(coordinate(value) >= 0);
      entries.emplace_back(row, coordinate(value), weight);
    }
  G_t_.resize(tied_.size(), n_coordinates_);
  G_t_.setFromTriplets(entries.begin(), entries.end());
}

AffineConstraints::AffineConstraints(const Lists &lists)
    : column_(lists.column), tied_row_(lists.tied_row), tied_(lists.tied), n_free_(lists.n_free),
      n_coordinates_(lists.n_coordinates)
{
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t row = 0; row + 1 < lists.tie_begin.size(); ++row)
    for (int k = lists.tie_begin[row]; k < lists.tie_begin[row + 1]; ++k)
      entries.emplace_back(row, lists.tie_column[k], lists.tie_weight[k]);
  G_t_.resize(tied_.size(), n_coordinates_);
  G_t_.setFromTriplets(entries.begin(), entries.end());
}

AffineConstraints::Lists AffineConstraints::of_nodes(const std::vector<int> &nodes) const
{
  Lists            lists;
  std::vector<int> number(n_coordinates_, -1); // position in the lists
  const auto       number_of = [&](int coordinate)
  {
    if (number[coordinate] < 0)
    {
      number[coordinate] = static_cast<int>(lists.coordinates.size());
      lists.coordinates.push_back(coordinate);
    }
    return number[coordinate];
  };
  for (const int node : nodes)
    for (int i = 3 * node; i < 3 * node + 3; ++i)
      lists.column.push_back(column_[i] < 0 ? -1 : number_of(column_[i]));
  lists.n_free = static_cast<int>(lists.coordinates.size());

  std::vector<std::pair<int, int>> ties; // rows of G_t, and their displacements in the lists
  for (std::size_t k = 0; k < lists.column.size(); ++k)
    if (const int row = tied_row_[3 * nodes[k / 3] + static_cast<int>(k % 3)]; row >= 0)
      ties.emplace_back(row, static_cast<int>(k));
  std::sort(ties.begin(), ties.end());
  lists.tied_row.assign(lists.column.size(), -1);
  lists.tie_begin.push_back(0);
  for (const auto &[row, displacement] : ties)
  {
    lists.tied_row[displacement] = static_cast<int>(lists.tied.size());
    lists.tied.push_back(displacement);
    for (decltype(G_t_)::InnerIterator entry(G_t_, row); entry; ++entry)
    {
      lists.tie_column.push_back(number_of(static_cast<int>(entry.col())));
      lists.tie_weight.push_back(entry.value());
    }
    lists.tie_begin.push_back(static_cast<int>(lists.tie_column.size()));
  }
  lists.n_coordinates = static_cast<int>(lists.coordinates.size());
  return lists;
}

int AffineConstraints::coordinate(int value) const
{
  const int n = n_displacements();
  return value < n ? column_[value] : new_column_[value - n];
}

Combination AffineConstraints::row(int displacement) const
{
  if (column_[displacement] >= 0)
    return {{column_[displacement], 1.}};
  Combination result;
  if (tied_row_[displacement] >= 0)
    for (decltype(G_t_)::InnerIterator entry(G_t_, tied_row_[displacement]); entry; ++entry)
      result.emplace_back(static_cast<int>(entry.col()), entry.value());
  return result;
}

Eigen::VectorXd AffineConstraints::expand(const Eigen::VectorXd &q) const
{
  const Eigen::VectorXd tied = G_t_ * q;
  Eigen::VectorXd       u    = Eigen::VectorXd::Zero(n_displacements());
  for (int i = 0; i < n_displacements(); ++i)
    if (column_[i] >= 0)
      u[i] = q[column_[i]];
    else if (tied_row_[i] >= 0)
      u[i] = tied[tied_row_[i]];
  return u;
}

Eigen::VectorXd AffineConstraints::gather(const Eigen::VectorXd &f) const
{
  Eigen::VectorXd tied = Eigen::VectorXd::Zero(G_t_.rows());
  Eigen::VectorXd free = Eigen::VectorXd::Zero(n_coordinates_);
  for (int i = 0; i < n_displacements(); ++i)
    if (column_[i] >= 0)
      free[column_[i]] = f[i];
    else if (tied_row_[i] >= 0)
      tied[tied_row_[i]] = f[i];
  return free + G_t_.transpose() * tied;
}

namespace
{

/// Calls visit(displacement of the column, value) along row 3 node + d of A.
template <typename Visit>
void along_row(const BlockMatrix &A, const BlockMatrix::Rows &rows, int node, int d, const Visit &visit)
{
  for (int k = rows.begin[node]; k < rows.begin[node + 1]; ++k)
    if (A.block_size() == 1)
      visit(3 * rows.columns[k] + d, rows.values[k]);
    else
      for (int e = 0; e < 3; ++e)
        visit(3 * rows.columns[k] + e, rows.values[9 * k + 3 * e + d]);
}

} // namespace

Eigen::SparseMatrix<double> AffineConstraints::project_free(const BlockMatrix                 &A,
                                                            const Eigen::SparseMatrix<double> &nearby) const
{
  // Free displacements keep their entries.  Column j is taken from row j, A being symmetric; both come ascending.
  const BlockMatrix::Rows rows         = A.rows();
  const auto              visit_column = [&](int i, const auto &visit)
  {
    Eigen::SparseMatrix<double>::InnerIterator more(nearby, column_[i]);
    along_row(A, rows, i / 3, i % 3,
              [&](int displacement, double value)
              {
                const int j = column_[displacement];
                if (j < 0)
                  return;
                for (; more && more.row() < j; ++more)
                  visit(more.row(), more.value());
                const bool both = more && more.row() == j;
                visit(j, both ? value + more.value() : value);
                if (both)
                  ++more;
              });
    for (; more; ++more)
      visit(more.row(), more.value());
  };

  Eigen::SparseMatrix<double> sum(n_coordinates_, n_coordinates_);
  int                         count = 0;
  for (int i = 0; i < n_displacements(); ++i)
    if (column_[i] >= 0)
    {
      visit_column(i, [&](int, double) { ++count; });
      sum.outerIndexPtr()[column_[i] + 1] = count;
    }
  for (int j = n_free_; j < n_coordinates_; ++j)
  {
    count += nearby.outerIndexPtr()[j + 1] - nearby.outerIndexPtr()[j];
    sum.outerIndexPtr()[j + 1] = count;
  }

  sum.resizeNonZeros(count);
  int        k   = 0;
  const auto put = [&](int row, double value)
  {
    sum.innerIndexPtr()[k] = row;
    sum.valuePtr()[k++]    = value;
  };
  for (int i = 0; i < n_displacements(); ++i)
    if (column_[i] >= 0)
      visit_column(i, put);
  for (int j = n_free_; j < n_coordinates_; ++j)
    for (Eigen::SparseMatrix<double>::InnerIterator more(nearby, j); more; ++more)
      put(int(more.row()), more.value());
  return sum;
}

Eigen::SparseMatrix<double> AffineConstraints::project(const BlockMatrix &A) const
{
  assert(3 * A.n_nodes() == n_displacements());
  if (tied_.empty())
    return project_free(A, Eigen::SparseMatrix<double>(n_coordinates_, n_coordinates_));

  const BlockMatrix::Rows rows = A.rows();

  // Tied displacements, rows G_t:  G^T A G = A_ff + Y G_t + (Y G_t)^T  with  Y = A_ft + 1/2 G_t^T A_tt.
  std::vector<Eigen::Triplet<double>> of_free, of_tied;
  for (std::size_t t = 0; t < tied_.size(); ++t)
    along_row(A, rows, tied_[t] / 3, tied_[t] % 3,
              [&](int j, double value)
              {
                if (column_[j] >= 0)
                  of_free.emplace_back(column_[j], t, value);
                else if (tied_row_[j] >= 0)
                  of_tied.emplace_back(tied_row_[j], t, 0.5 * value);
              });
  const int                   n_tied = static_cast<int>(tied_.size());
  Eigen::SparseMatrix<double> Y(n_coordinates_, n_tied), A_tt(n_tied, n_tied);
  Y.setFromTriplets(of_free.begin(), of_free.end());
  A_tt.setFromTriplets(of_tied.begin(), of_tied.end());
  const Eigen::SparseMatrix<double> G_t = G_t_;
  Y += Eigen::SparseMatrix<double>(G_t.transpose() * A_tt);
  const Eigen::SparseMatrix<double> X  = Y * G_t;
  const Eigen::SparseMatrix<double> XT = X.transpose();
  return project_free(A, X + XT);
}

} // namespace gestell::fem
