#pragma once

#include "coupling/linear_base.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace gestell::coupling
{

/**
 * Small dense base system, with the structure that Craig-Bampton coordinates have.  With L the modal coordinates, N the
 * others,
 *
 *     M = [ M_NN  M_NL ]      C = [ C_NN   0   ]      B = [ B_NN  B_NL ]
 *         [ M_LN   E   ]          [  0    C_LL ],         [ B_LN  B_LL ],     C_LL diagonal, B_LL diagonal or full.
 *
 * Multiplications leave out the zeros.  factorise() condenses L (5.5.3/1-7) where B_LL is diagonal:
 *
 *     q_N = A_red^-1 (f_N - A_NL A_LL^-1 f_L),     q_L = A_LL^-1 (f_L - A_LN q_N).
 *
 * Where modal damping of the supported frame fills B_LL, the inverse of the whole A is kept, which for some sixty
 * coordinates multiplies faster than two triangles are solved.  A is scaled to unit diagonal before it is inverted, so
 * that metres and radians do not spoil its condition.  Nothing allocates after factorise().
 *
 * Workspaces are kept inside: one object serves one thread at a time.
 */
class DenseBase : public LinearBase
{
public:
  /// @param M, B, C            symmetric [n x n]
  /// @param modal_coordinates  L, without repeats; may be empty
  /// @throws std::invalid_argument for sizes, symmetry or structure that do not fit
  DenseBase(const Eigen::MatrixXd &M, const Eigen::MatrixXd &B, const Eigen::MatrixXd &C,
            const std::vector<int> &modal_coordinates);

  int                           size() const override { return int(order_.size()); }
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
  /// A matrix in the order (N, L), by the blocks that are not zero.
  struct Blocks
  {
    Eigen::MatrixXd NN;       // [n_N x n_N]
    Eigen::MatrixXd LN;       // [n_L x n_N]; empty if zero
    Eigen::VectorXd diagonal; // [n_L] of LL
    Eigen::MatrixXd LL;       // [n_L x n_L]; empty if diagonal
  };
  Blocks blocks_of(const Eigen::MatrixXd &A) const;
  void   multiply(const Blocks &A, const Eigen::VectorXd &x, Eigen::VectorXd &y) const;
  void   multiply_sorted(const Blocks &A, const Eigen::VectorXd &x, Eigen::VectorXd &y) const; ///< in the order (N, L)

  Eigen::MatrixXd         M_, B_, C_;
  std::vector<int>        order_;          // N, then L
  bool                    sorted_ = false; // that is the order of the coordinates
  int                     n_N_    = 0;
  Blocks                  mass_, damping_, stiffness_;
  mutable Eigen::VectorXd x_, y_; // in the order (N, L)
};

} // namespace gestell::coupling
