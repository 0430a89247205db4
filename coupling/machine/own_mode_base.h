#pragma once

#include "coupling/algebra/packed_matrix.h"
#include "coupling/machine/linear_base.h"
#include "coupling/machine/own_modes.h"

namespace gestell::coupling
{

/**
 * A base system with the frame in its own modes, coordinates 0 .. n1 + m - 1, and other coordinates, which the matrices
 * couple to q1 alone.  Condenses eta_b to the others N: with K = R D_b^-1 R^T and H = D_a^-1 + K,
 *
 *     g = R D_b^-1 f_L,  (A_NN' + S^T H^-1 S) q_N = f_N + S^T H^-1 g,  l = H^-1 (S q1 - g),  eta_b = D_b^-1 (f_L + R^T
 * l)
 */
class OwnModeBase final : public LinearBase
{
public:
  /// @param M,  B, C  [n x n] of everything, in the turned coordinates
  /// @param plain  the same without regard to its structure, for weights with which a mode has no value above zero
  OwnModeBase(const Eigen::MatrixXd &M, const Eigen::MatrixXd &B, const Eigen::MatrixXd &C, OwnModes modes,
              std::unique_ptr<LinearBase> plain);

  int                           size() const override { return plain_->size(); }
  void                          mass_times(const Eigen::VectorXd &x, Eigen::VectorXd &y) const override;
  void                          damping_times(const Eigen::VectorXd &x, Eigen::VectorXd &y) const override;
  void                          stiffness_times(const Eigen::VectorXd &x, Eigen::VectorXd &y) const override;
  std::unique_ptr<LinearSolver> factorise(double w_M, double w_B, double w_C) const override;
  std::vector<SpectrumLine>     spectrum() const override { return plain_->spectrum(); }
  const LinearBase             &plain() const override { return *plain_; }

private:
  /// A matrix by its values in the modes a that it has, in b, and its block of N.
  struct Blocks
  {
    Eigen::MatrixXd NN;            // [n_N x n_N] of everything beside the frame
    PackedMatrix    packed, DS, R; // NN of everything; D_a S; R^T
    Eigen::VectorXd a, b;          // D
  };
  Blocks blocks_of(const Eigen::MatrixXd &A, const Eigen::VectorXd &values) const;
  void   multiply(const Blocks &A, const Eigen::VectorXd &x, Eigen::VectorXd &y) const;

  OwnModes                    modes_;
  std::unique_ptr<LinearBase> plain_;
  std::vector<int>            N_;
  Blocks                      mass_, damping_, stiffness_;
  mutable Eigen::VectorXd     x_N_, y_N_, r_, t_; ///< padded
};

} // namespace gestell::coupling
