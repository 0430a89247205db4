#pragma once

#include "coupling/integration/propagation/modal_blocks.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace gestell::coupling
{

/**
 * The base system of a machine as it answers harmonic forces F e^(i w t), in its complex modes:
 *
 *     q = Y(w) F,     Y = (-w^2 M + i w B + C)^-1 = Q (i w E - Lambda)^-1 G,
 *
 * so that a frequency costs two multiplications per mode and entry, and no factor.  Virtual coordinates T x' + x = f
 * are states of their own.
 *
 * Source: docs/frf.md (3).
 */
class BaseReceptance
{
public:
  /// @throws std::invalid_argument if the matrices are not dense, a coordinate has no mass or eigenvectors coincide
  explicit BaseReceptance(const LinearSystem &base);

  Eigen::Index           n_states() const { return Q_.cols(); }
  const Eigen::MatrixXd &Q() const { return Q_; } ///< [n x n_x]
  const Eigen::MatrixXd &G() const { return G_; } ///< [n_x x n]

  /// X becomes (i w E - Lambda)^-1 X, [n_x x columns].  A block that is undamped and driven at its own frequency makes
  /// it infinite.
  void divide(double omega, Eigen::MatrixXcd &X) const;

private:
  std::vector<ModalBlock> blocks_;
  std::vector<double>     decay_; ///< -1/T [1/s] of the virtual coordinates, whose states stand behind the blocks
  Eigen::MatrixXd         Q_, G_;
};

} // namespace gestell::coupling
