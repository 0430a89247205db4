#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <vector>

namespace gestell::coupling
{

/**
 * LU factors of sparse matrices K of one pattern with given pivots, by a list of all multiplications: with a few
 * numbers per row, loops over rows and columns take longer than these.  For each pivot k, in place of P K Q,
 *
 *     l_ik = a_ik / a_kk,     a_ij -= l_ik a_kj     for all i in column k and all j in row k that are not zero.
 *
 * Nothing allocates after construction.
 */
class Elimination
{
public:
  /// @param K           its pattern
  /// @param rows,  columns  of the pivots k, in their order
  Elimination(const Eigen::SparseMatrix<double> &K, const int *rows, const int *columns);

  /// Numbers of L + U, to be filled with those of K: entry e of its pattern at place(e), all others zero.
  std::vector<double> &entries() { return a_; }
  int                  place(int e) const { return place_[std::size_t(e)]; }

  void   factorise();
  double pivot(int k) const { return pivot_[std::size_t(k)]; }
  int    row(int k) const { return pivots_[std::size_t(k)].row; }
  int    column(int k) const { return pivots_[std::size_t(k)].column; }
  /// y := K^-1 y
  void solve_in_place(Eigen::VectorXd &y);

private:
  /// Column k of L + U, a_[begin] to a_[end - 1]; products until `last`.
  struct Pivot
  {
    int row, column; ///< in K
    int begin, diagonal, end, last;
  };
  /// a_target -= a_l a_u
  struct Product
  {
    int l, u, target;
  };
  /// y_to -= a_entry y_from
  struct Substitution
  {
    int entry, from, to;
  };

  void list_work(const std::vector<std::vector<int>> &columns);
  int  position(int row, int column) const;

  std::vector<Pivot>        pivots_;
  std::vector<int>          rows_;  ///< of the entries of L + U
  std::vector<int>          place_; ///< of the entries of K in L + U
  std::vector<Product>      products_;
  std::vector<Substitution> forward_, backward_;
  std::vector<double>       a_;                   ///< L, U + E with the rows of U divided by the pivots
  std::vector<double>       pivot_, inverse_, y_; ///< a_kk, 1/a_kk, y in the order of the pivots
};

} // namespace gestell::coupling
