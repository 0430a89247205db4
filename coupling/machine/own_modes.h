#pragma once

#include "coupling/frame/reduced_frame.h"
#include "coupling/machine/dense_base.h"

#include <optional>

namespace gestell::coupling
{

/**
 * The modes of a reduced frame whose damping is diagonal in them, as modal damping of the supported frame is, in the
 * coordinates (q1, eta_b) of in_own_modes(). With eta_a, as many modes as q1 has coordinates,
 *
 *     eta_a = S q1 - R eta_b,     S = Phi_1a^-1,   R = S Phi_1b,
 *
 * each of M, B, C and A = w_M M + w_B B + w_C C is diag(D_a, D_b) of the modes, D = w_M + w_B d + w_C omega^2:
 *
 *     A = [ S^T D_a S          -S^T D_a R       ]
 *         [-R^T D_a S     D_b + R^T D_a R       ]
 *
 * so that products and solutions cost O(n1 m), not the O((n1 + m)^2) of full damping between fixed-interface modes.
 */
struct OwnModes
{
  Eigen::MatrixXd S, R;             ///< [n1 x n1], [n1 x m]
  Eigen::VectorXd damping, squares; ///< [n1 + m] d [1/s] and omega^2 of a, then of b
};

/// Turns a frame to its own modes if steps are cheaper there: damping couples its many fixed-interface modes, and is
/// diagonal in its own. Interface coordinates stay. Turning twice changes nothing but rounding. Returns the modes, or
/// nothing if it is left as it is.
std::optional<OwnModes> turn_to_own_modes(ReducedFrame &frame);

/**
 * A base system with the frame in its own modes, coordinates 0 .. n1 + m - 1, and other coordinates, which the matrices
 * couple to q1 alone.  Condenses eta_b to the others N: with K = R D_b^-1 R^T and H = D_a^-1 + K,
 *
 *     g = R D_b^-1 f_L,  (A_NN' + S^T H^-1 S) q_N = f_N + S^T H^-1 g,  l = H^-1 (S q1 - g),  eta_b = D_b^-1 (f_L + R^T
 * l)
 */
class OwnModeBase final : public DenseBase
{
public:
  /// @param M,  B, C  [n x n] of everything, in the turned coordinates
  OwnModeBase(const Eigen::MatrixXd &M, const Eigen::MatrixXd &B, const Eigen::MatrixXd &C, OwnModes modes);

  void                          mass_times(const Eigen::VectorXd &x, Eigen::VectorXd &y) const override;
  void                          damping_times(const Eigen::VectorXd &x, Eigen::VectorXd &y) const override;
  void                          stiffness_times(const Eigen::VectorXd &x, Eigen::VectorXd &y) const override;
  std::unique_ptr<LinearSolver> factorise(double w_M, double w_B, double w_C) const override;

private:
  /// A matrix by its values in the modes, and its block of N.
  struct Blocks
  {
    Eigen::MatrixXd NN;         // [n_N x n_N] of everything
    PackedMatrix    packed, DS; // NN; D_a S [n1 x n1]
    Eigen::VectorXd a, b;       // D
  };
  Blocks blocks_of(const Eigen::MatrixXd &A, const Eigen::VectorXd &values) const;
  void   multiply(const Blocks &A, const Eigen::VectorXd &x, Eigen::VectorXd &y) const;

  OwnModes                modes_;
  std::vector<int>        N_;
  PackedMatrix            R_; // [m x n1] R^T
  Blocks                  mass_, damping_, stiffness_;
  mutable Eigen::VectorXd x_N_, y_N_, r_, t_; ///< padded
};

} // namespace gestell::coupling
