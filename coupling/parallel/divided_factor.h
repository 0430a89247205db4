#pragma once

#include "coupling/algebra/front_division.h"
#include "coupling/algebra/tiled_panels.h"
#include "coupling/eigensolvers/block_lanczos.h"
#include "fem/parallel/ranks.h"
#include "fem/values/sparse_matrix.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <memory>
#include <vector>

namespace gestell::coupling
{

/// Matrices on rank 0 to be distributed; empty on others.
struct MatricesOnFirst
{
  const Eigen::SparseMatrix<double> *C       = nullptr; // [n x n] both triangles, compressed
  const Eigen::SparseMatrix<double> *M       = nullptr; // the same, or none
  std::vector<int>                   held    = {};      // ascending
  Eigen::SparseMatrix<double>       *given_C = nullptr; // in place of C: emptied, so that each rank keeps only its part
};

/**
 * Cholesky factor of C, with fixed coordinates, distributed among ranks by subtrees of its elimination.
 *
 * Each rank has the rows of its own subtrees, followed by those of the top (the border), which all ranks have.  With
 * the rows i of one rank and b of the border
 *
 *     C = sum over ranks of  [ C_ii  C_ib ],      S = C_bb - sum C_bi C_ii^-1 C_ib,
 *                            [ C_bi  .    ]
 *
 * each rank computes the factor of its C_ii and its part of S; rank 0 adds these parts and computes the factor of S.
 * Loads are additive: the load on the border is the sum over the ranks.  Motions of the border are equal on all ranks.
 * Products with M are also additive: rank 0 has M_bb.
 *
 * Every function is collective.
 *
 * Source: Duff & Reid, ACM Trans. Math. Software 9 (1983) 302-325; Geist & Ng, Int. J. Parallel Programming 18 (1989)
 * 291-314 (subtrees for each).
 */
class DividedFactor
{
public:
  /// Divides; no factor yet.  @param on_first of rank 0: C and M must outlive this.
  DividedFactor(const fem::Ranks &ranks, const MatricesOnFirst &on_first);

  const fem::Ranks &ranks() const { return ranks_; }
  int               n() const { return n_; }                   ///< coordinates
  int               n_rows() const { return own_.fronts().n; } ///< on this rank, those of the border last
  int               n_own() const { return own_.columns(); }   ///< rows of this rank alone
  /// Positions of the rows in the elimination of all.
  const std::vector<int> &places() const { return own_.places; }
  /// Fixed rows, ascending.
  const std::vector<int> &held() const { return held_; }
  /// This rank's part of M, by its rows.
  fem::SparseMatrix own_M() const;
  /// The same of C, unless it was passed as given_C.
  fem::SparseMatrix own_C() const;

  /// Computes the factor if needed. @returns -1, or the coordinate of a pivot that is not positive, on rank 0.
  int    factorise();
  void   release();
  double pivot_ratio() const; ///< (smallest / largest diagonal entry of L)^2

  /// X <- C^-1 X, from loads to motions, with the rows of this rank.
  void solve_in_place(MultiVector &X) const;
  /// The same for columns on rank 0, in the order of its coordinates; zero at fixed ones.
  void solve_on_first(Eigen::Ref<Eigen::MatrixXd> X) const;

  /// Inertia of C - sigma M; the growth is an upper bound.
  Inertia inertia(double sigma) const;

  /// Distributes a matrix on rank 0, by coordinates, to the rows of each rank, and collects it.
  void deal_out(const Eigen::Ref<const Eigen::MatrixXd> &X, Eigen::MatrixXd &rows) const;
  void collect(const Eigen::MatrixXd &rows, Eigen::Ref<Eigen::MatrixXd> X) const;

private:
  /// An elimination of all fronts, in two steps.
  struct Passing;

  void       divide(const FrontDivision &division);
  void       send_share(const FrontDivision &division, int rank);
  void       keep_share(const FrontDivision &division);
  void       receive_share();
  void       mark_held_rows();
  HeldMatrix matrix(double sigma) const;
  int        coordinate_of(int rank, int place) const;
  int        told_to_first(int place) const;
  void       reserve();
  int        n_border() const { return n_rows() - own_.columns(); }

  fem::Ranks                    ranks_;
  int                           n_ = 0;
  MatricesOnFirst               on_first_;
  double                        typical_ = 1.; // of C's diagonal
  FrontSelection                own_, top_;    // `order`: positions in the eliminated matrix, see matrix()
  std::vector<int>              givers_;
  std::vector<std::vector<int>> columns_of_;  // rank 0: coordinates of each rank's own rows
  std::vector<int>              coordinates_; // rank 0: of its rows
  std::vector<int>              held_;
  std::vector<char>             held_marks_; // by the positions in the matrix
  fem::SparseMatrix             C_, M_;      // parts of this rank; rank 0 has C_ if there is given_C, and the whole M
  TiledPanels                   L_, L_top_;
  bool                          factored_ = false;
};

/// For the search of modes on all ranks; the factor must outlive it.
class InverseOnRanks final : public InverseStiffness
{
public:
  explicit InverseOnRanks(const DividedFactor &factor);
  void                    solve_in_place(MultiVector &X) const override { factor_.solve_in_place(X); }
  const std::vector<int> &order() const override { return order_; }
  const std::vector<int> &held() const override { return factor_.held(); }
  int                     size() const override { return factor_.n(); }
  int                     owned() const override;
  void                    complete(Eigen::MatrixXd &X) const override;
  void                    add_up(Eigen::MatrixXd &X) const override;
  void                    sum(Eigen::MatrixXd &X) const override;
  void                    share(Eigen::MatrixXd &X) const override;
  int                     place(int row) const override { return factor_.places()[row]; }

private:
  const DividedFactor &factor_;
  std::vector<int>     order_;
};

} // namespace gestell::coupling
