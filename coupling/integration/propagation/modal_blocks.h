#pragma once

#include "coupling/integration/system/second_order_system.h"

#include <Eigen/Core>

#include <functional>
#include <string>
#include <vector>

namespace gestell::coupling
{

/// x' = Lambda x of two real states:
///   oscillating  [s -w; w s]   eigenvalues s +- i w
///   decaying     [s 0; 0 w]    two real ones, zero included
///   free         [0 1; 0 0]    displacement and velocity of a motion without stiffness and damping
struct ModalBlock
{
  enum Kind
  {
    oscillating,
    decaying,
    free
  };
  Kind   kind;
  double s, w; ///< [1/s]
};

/**
 * A linear system M q'' + B q' + C q = f in blocks of its (complex) modes:
 *
 *     x' = Lambda x + G f,     q = Q x,   q' = V x,     Lambda block diagonal, x [2 n_b].
 *
 * Motions without stiffness are found as the null space of C scaled to unit diagonal, and treated exactly: as free
 * blocks (a double zero eigenvalue) if B does not damp them, otherwise with one zero and one decaying eigenvalue.  With
 * proportional damping the modes are real; any other damping requires the eigenvectors of the state matrix, scaled so
 * that it is nearly skew-symmetric.
 *
 * The blocks of the modes are followed by those of the load: each harmonic is a separate rotating block without input,
 * whose columns of Q and V are the forced motion.
 */
struct ModalBlocks
{
  std::vector<ModalBlock> blocks;
  int                     n_modal = 0;    ///< blocks of the system itself; those of harmonics follow
  Eigen::MatrixXd         Q, V;           ///< [n x 2 n_b]
  Eigen::MatrixXd         G;              ///< [2 n_modal x n]
  Eigen::MatrixXd         from_q, from_v; ///< x = from_q q + from_v q' of the modal blocks [2 n_modal x n]
  std::vector<double>     harmonics;      ///< omega of the blocks after the modal ones

  /// x [2 n_b] at t for q, q' [n].
  Eigen::VectorXd state(double t, const Eigen::VectorXd &q, const Eigen::VectorXd &v) const;
  /// Sets the states of the harmonics to those at t.
  void turn_harmonics(double t, Eigen::VectorXd &x) const;
};

/// Blocks of symmetric matrices [n x n], without loads.
/// @param coordinate_name  of coordinate i, for messages
/// @throws std::invalid_argument: M is singular, or eigenvectors coincide
ModalBlocks modal_blocks(const Eigen::MatrixXd &M, const Eigen::MatrixXd &B, const Eigen::MatrixXd &C,
                         const std::function<std::string(int)> &coordinate_name);

/// The modes of the latest matrices, shared by systems of a family that have the same matrices but different forces and
/// loads.
class SharedModes
{
public:
  /// Like modal_blocks(M, B, C, coordinate_name), recomputed if a matrix differs in any digit.
  const ModalBlocks &of(const Eigen::MatrixXd &M, const Eigen::MatrixXd &B, const Eigen::MatrixXd &C,
                        const std::function<std::string(int)> &coordinate_name);
  int                found() const { return found_; } ///< number of computations

private:
  Eigen::MatrixXd M_, B_, C_;
  ModalBlocks     blocks_;
  int             found_ = 0;
};

/// @param shared  modes shared with systems of the same matrices; null: the modes are recomputed
/// @throws std::invalid_argument with the reason: the system is not dense, M is singular, the load is not a sum of
/// harmonics, an undamped mode is excited at its own frequency, or eigenvectors coincide.
ModalBlocks modal_blocks(const SecondOrderSystem &system, SharedModes *shared = nullptr);

/// F(Lambda h) for functions F of a complex number: [f11 f12; f21 f22] for the kind of the block.
struct Block2
{
  double a11, a12, a21, a22;
};

/// phi_0(Z) .. phi_k(Z), Z = Lambda h:  phi_0 = exp, phi_k+1(z) = (phi_k(z) - 1/k!)/z.
void phi_functions(const ModalBlock &block, double h, int k, Block2 *phi);

} // namespace gestell::coupling
