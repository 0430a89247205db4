#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <functional>

namespace gestell::coupling
{

/// X <- C^-1 X for all columns.
using InverseStiffness = std::function<void(Eigen::Ref<Eigen::MatrixXd> X)>;

struct LowestModes
{
  Eigen::VectorXd omega; // [m] ascending, rad/s
  Eigen::MatrixXd V;     // [n x m], V^T M V = E
  Eigen::VectorXd bound; // [m] an exact frequency lies within omega (1 +- bound)
};

/// Looks for the lowest modes of (C - omega^2 M) v = 0.
class ModeSearch
{
public:
  virtual ~ModeSearch() = default;

  /// Goes on until the lowest `count` modes are found and a gap above them, or all modes there are.
  /// @throws ConvergenceFailure with the number found: M has a lower rank, or too many steps.
  virtual void find(int count) = 0;

  /// The lowest of those found, in an unbroken sequence.
  virtual LowestModes modes(int count) const = 0;

  /// Frequencies [rad/s] without a mode, as far as is known, and how many found lie below: for a count by other means.
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
 * frequencies that are repeated as often as it has columns.  Every step appends A times the last block, made orthogonal
 * to all before (M-orthonormal Q, fully reorthogonalised); the projected T = Q^T M A Q gives
 *
 *     T s = theta s,   omega = theta^(-1/2),   v = Q s,   |A v - theta v|_M = |E s| = r
 *
 * with E the coupling of T to the next block.  Since A is self-adjoint in the inner product of M, an exact theta lies
 * within r of the computed one: |delta omega| / omega <= r / (2 theta - 2 r), and about the square of that where the
 * frequency stands alone.
 *
 * The inverse may hold coordinates (give zero for them): then the modes are those of the held structure.  A block that
 * breaks down is continued with vectors of any direction, until the whole range of M is used up.  The space starts anew
 * from its best vectors where it would outgrow `room` (thick restart).
 *
 * Source: Grimes, Lewis & Simon, SIAM J. Matrix Anal. Appl. 15 (1994) 228-272; Wu & Simon, ibid. 22 (2000) 602-616.
 */
class BlockLanczos final : public ModeSearch
{
public:
  struct Options
  {
    int    block     = 12;   ///< right-hand sides at once, >= 1
    double tolerance = 1e-8; ///< r / theta from which a mode counts as found
    int    room      = 0;    ///< vectors of the space held at most; 0: 3.2 GB of them, and enough for the modes wanted
  };

  /// @param M      [n x n] symmetric, positive semidefinite, both triangles stored; must outlive this.
  /// @param known  modes found elsewhere: part of the space from the start.
  BlockLanczos(const Eigen::SparseMatrix<double> &M, InverseStiffness inverse, const Options &options,
               const LowestModes &known = {});

  void        find(int count) override;
  LowestModes modes(int count) const override;
  Gap         gap_above(int count) const override;

  int n_found() const;                    ///< in an unbroken sequence from the lowest
  int n_vectors() const { return size_; } ///< of the space

private:
  void start_block();
  void step();
  void restart(int keep);
  void append_block(const Eigen::MatrixXd &block);
  void set_next(Eigen::MatrixXd W, Eigen::MatrixXd MW, const Eigen::VectorXd &scale);
  void solve_projected();
  int  gap_index(int count) const;

  const Eigen::SparseMatrix<double> &M_;
  InverseStiffness                   inverse_;
  Options                            options_;
  Eigen::Index                       n_;
  int                                size_ = 0, room_ = 0; // columns of Q in use and allocated
  int                                coupled_   = 0;       // first column of Q that the last block couples to
  bool                               exhausted_ = false;
  unsigned long                      seed_      = 1;
  Eigen::MatrixXd                    Q_, T_;
  Eigen::MatrixXd                    next_, M_next_, E_; // T's rows of the next block: E [block x size]
  Eigen::MatrixXd                    M_last_;            // M times the columns of Q from coupled_ on
  Eigen::VectorXd                    theta_, residual_;  // of T, descending
  Eigen::MatrixXd                    S_;
};

} // namespace gestell::coupling
