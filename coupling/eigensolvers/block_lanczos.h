#pragma once

#include "coupling/algebra/multivector.h"
#include "coupling/algebra/sparse_cholesky.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <algorithm>
#include <functional>
#include <memory>
#include <vector>

namespace gestell::coupling
{

/// C^-1, applied to many columns at once, with their rows in the order of the factor.
class InverseStiffness
{
public:
  virtual ~InverseStiffness() = default;
  /// X <- C^-1 X; row k of X is that of coordinate order()[k].
  virtual void                    solve_in_place(MultiVector &X) const = 0;
  virtual const std::vector<int> &order() const                        = 0;
  /// Coordinates (ascending) without motion.
  virtual const std::vector<int> &held() const = 0;

  /// X [coordinates x k] <- C^-1 X.
  virtual void solve_columns(Eigen::Ref<Eigen::MatrixXd> X) const;

  // If several processes have rows of X each, all of them call the following functions together:

  /// The first coordinates here are owned by this process, the others by another process.
  virtual int owned() const { return int(order().size()); }
  /// X [coordinates x k]: copies the values of coordinates that another process owns.
  virtual void complete(Eigen::MatrixXd &) const {}
  /// The same for loads: adds the values at coordinates of another process there.
  virtual void add_up(Eigen::MatrixXd &) const {}

  /// Coordinates, those of other processes included.
  virtual int size() const { return int(order().size()); }
  /// Sum of the partial results of all processes; the same on all.
  virtual void sum(Eigen::MatrixXd &) const {}
  /// Broadcasts the numbers of the first process, so that rounding is the same on all.
  virtual void share(Eigen::MatrixXd &) const {}
  /// Place of a row among those of all.
  virtual int place(int row) const { return row; }
};

/// By a factor, which must outlive it, in its order of elimination.
class InverseByFactor final : public InverseStiffness
{
public:
  /// @param held  those of the factor.
  explicit InverseByFactor(const SparseCholesky &factor, std::vector<int> held = {})
      : factor_(factor), order_(factor.order()), held_(std::move(held))
  {
  }
  void                    solve_in_place(MultiVector &X) const override { factor_.solve_in_place(X); }
  void                    solve_columns(Eigen::Ref<Eigen::MatrixXd> X) const override { factor_.solve_in_place(X); }
  const std::vector<int> &order() const override { return order_; }
  const std::vector<int> &held() const override { return held_; }

private:
  const SparseCholesky &factor_;
  std::vector<int>      order_, held_;
};

/// By any function that solves for the columns of a matrix; slower, because the columns are copied.
class InverseByColumns final : public InverseStiffness
{
public:
  using Solve = std::function<void(Eigen::Ref<Eigen::MatrixXd> X)>;
  /// @param held  coordinates that the function leaves without motion, ascending.
  InverseByColumns(int n, Solve solve, std::vector<int> held = {});
  void                    solve_in_place(MultiVector &X) const override;
  void                    solve_columns(Eigen::Ref<Eigen::MatrixXd> X) const override { solve_(X); }
  const std::vector<int> &order() const override { return order_; }
  const std::vector<int> &held() const override { return held_; }

private:
  Solve            solve_;
  std::vector<int> order_, held_;
};

struct LowestModes
{
  Eigen::VectorXd omega; // [m] ascending, rad/s
  Eigen::MatrixXd V;     // [n x m], V^T M V = E
  Eigen::VectorXd bound; // [m] an exact frequency lies within omega (1 +- bound)
};

/// Computes the lowest modes of (C - omega^2 M) v = 0.
class ModeSearch
{
public:
  virtual ~ModeSearch() = default;

  /// Continues until the lowest `count` modes and a gap above them are found, or all existing modes.
  /// @throws ConvergenceFailure with the number found: M has a lower rank, or too many steps.
  virtual void find(int count) = 0;

  /// The lowest modes found, without a missing one between them.
  virtual LowestModes modes(int count) const = 0;

  /// A frequency range [rad/s] without a found mode, and the number of found modes below it, for verification by
  /// counting.
  struct Gap
  {
    double low, high; // high is infinite where no further mode exists
    int    below;
  };
  /// The first gap above `count` modes.
  /// @throws std::logic_error before find().
  virtual Gap gap_above(int count) const = 0;
};

/**
 * The lowest modes of (C - omega^2 M) v = 0 by block Lanczos for A = C^-1 M in the inner product of M.
 *
 * One solution with a block of right-hand sides costs little more than one with a single vector, and a block finds
 * frequencies with a multiplicity up to its number of columns.  Every step appends A times the last block,
 * orthogonalised to all before (M-orthonormal Q, fully reorthogonalised); the projected T = Q^T M A Q gives
 *
 *     T s = theta s,   omega = theta^(-1/2),   v = Q s,   |A v - theta v|_M = |E s| = r
 *
 * where E is the coupling of T to the next block.  Because A is self-adjoint in the inner product of M, there is an
 * exact theta within r of the computed one: |delta omega| / omega <= r / (2 theta - 2 r), and about the square of that
 * for an isolated frequency.
 *
 * If the inverse fixes coordinates, the modes are those of the fixed structure. A block that breaks down is continued
 * with arbitrary vectors, until the whole range of M is used. The space restarts from its best vectors when it would
 * exceed `room` (thick restart).
 *
 * Source: Grimes, Lewis & Simon, SIAM J. Matrix Anal. Appl. 15 (1994) 228-272; Wu & Simon, ibid. 22 (2000) 602-616.
 */
class BlockLanczos final : public ModeSearch
{
public:
  struct Options
  {
    /// Number of right-hand sides at once, >= 1.  Eight take as long in total as twelve or sixteen, with less memory.
    int    block     = 8;
    double tolerance = 1e-8; ///< r / theta below which a mode is accepted
    int    room      = 0;    ///< largest number of vectors of the space; 0: 3.2 GB, and enough for the modes requested
  };

  /// @param M      [n x n] symmetric, positive semidefinite, both triangles stored; with several processes each has a
  ///               part of the sum.
  /// @param known  modes found elsewhere: part of the space from the start.
  BlockLanczos(const Eigen::SparseMatrix<double> &M, std::shared_ptr<const InverseStiffness> inverse,
               const Options &options, const LowestModes &known = {});

  void        find(int count) override;
  LowestModes modes(int count) const override;
  Gap         gap_above(int count) const override;
  LowestModes values(int count) const; ///< modes() without V

  int  n_found() const;                           ///< lowest modes found without a missing one
  int  n_vectors() const { return Q_.columns(); } ///< of the space
  bool exhausted() const { return exhausted_; }   ///< the space spans the whole range of M

private:
  Eigen::MatrixXd product(const MultiVector &X, const MultiVector &MX) const;
  Eigen::MatrixXd projection(const MultiVector &MX, int from = 0) const;
  void            start_block();
  void            step();
  void            restart(int keep);
  void            set_next(const Eigen::VectorXd &scale);
  void            solve_projected();
  int             gap_index(int count) const;

  std::shared_ptr<const InverseStiffness> inverse_;
  ReorderedMatrix                         M_;
  Options                                 options_;
  int                                     n_, room_;      // rows here, and vectors of the space at most
  int                                     coupled_   = 0; // first column of Q that the last block couples to
  bool                                    exhausted_ = false;
  unsigned long                           seed_      = 1;
  KrylovBasis                             Q_;
  Eigen::MatrixXd                         T_, E_;            // E: T's rows of the next block [block x size]
  MultiVector                             next_, M_next_;    // the next block, and M times it
  Eigen::VectorXd                         theta_, residual_; // of T, descending
  Eigen::MatrixXd                         S_;
};

} // namespace gestell::coupling
