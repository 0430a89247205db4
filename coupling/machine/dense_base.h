#pragma once

#include "coupling/algebra/packed_matrix.h"
#include "coupling/machine/condensed_solver.h"
#include "coupling/machine/linear_base.h"

#include <Eigen/Core>

#include <vector>

namespace gestell::coupling
{

/**
 * Small dense base system with the structure of Craig-Bampton coordinates.  With the modal coordinates L and the others
 * N,
 *
 *     M = [ M_NN  M_NL ]      C = [ C_NN   0   ]      B = [ B_NN  B_NL ]
 *         [ M_LN   E   ]          [  0    C_LL ],         [ B_LN  B_LL ],     C_LL diagonal, B_LL diagonal or full.
 *
 * Products skip the zeros.  factorise() condenses L (5.5.3/1-7) if B_LL is diagonal:
 *
 *     q_N = A_red^-1 (f_N - A_NL A_LL^-1 f_L),     q_L = A_LL^-1 (f_L - A_LN q_N);
 *
 * N are then the leading coordinates (LinearSolver).  For loads M h + f of a step a single pass over M_LN suffices for
 * each of the two equations if A_LN is a multiple of it, as with Rayleigh damping or none between q_N and q_L.
 *
 * If modal damping of the supported frame fills B_LL, the inverse of the whole A is stored: for about sixty coordinates
 * its product is faster than two triangular solutions.  A is scaled to unit diagonal before it is inverted, so that the
 * mixture of metres and radians does not impair its condition.  Nothing allocates after factorise().
 *
 * Workspaces are members: an object must be used by one thread at a time.
 */
class DenseBase : public LinearBase
{
public:
  /// @param M,  B, C  symmetric [n x n]
  /// @throws std::invalid_argument for wrong sizes, symmetry or structure
  DenseBase(const Eigen::MatrixXd &M, const Eigen::MatrixXd &B, const Eigen::MatrixXd &C, const ModalRange &modal = {});

  int                           size() const override { return int(M_.rows()); }
  void                          mass_times(const Eigen::VectorXd &x, Eigen::VectorXd &y) const override;
  void                          damping_times(const Eigen::VectorXd &x, Eigen::VectorXd &y) const override;
  void                          stiffness_times(const Eigen::VectorXd &x, Eigen::VectorXd &y) const override;
  std::unique_ptr<LinearSolver> factorise(double w_M, double w_B, double w_C) const override;
  std::vector<SpectrumLine>     spectrum() const override;

  /// The matrices in the order of the coordinates.
  const Eigen::MatrixXd &mass() const { return M_; }
  const Eigen::MatrixXd &damping() const { return B_; }
  const Eigen::MatrixXd &stiffness() const { return C_; }

private:
  /// A matrix by the blocks that are not zero.
  struct Blocks
  {
    PackedMatrix    NN;       // [n_N x n_N]
    Eigen::VectorXd alone;    // [n_N] of NN if it is diagonal, as for bodies in a plane; else empty
    PackedMatrix    LN;       // [n_L x k] its first columns, up to the last non-zero one
    Eigen::VectorXd diagonal; // [n_L] of LL
    Eigen::MatrixXd LL;       // [n_L x n_L]; empty if diagonal
  };
  Blocks blocks_of(const Eigen::MatrixXd &A) const;
  void   multiply(const Blocks &A, const Eigen::VectorXd &x, Eigen::VectorXd &y) const;

  Eigen::MatrixXd         M_, B_, C_;
  ModalRange              L_;
  std::vector<int>        N_;
  Blocks                  mass_, damping_, stiffness_;
  mutable Eigen::VectorXd x_N_, y_N_; ///< y_N padded
};

} // namespace gestell::coupling
