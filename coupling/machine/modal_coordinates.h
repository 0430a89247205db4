#pragma once

#include <Eigen/Core>

namespace gestell::coupling
{

/**
 * Modal coordinates (5.5.3/8-10): q = V p with m columns, m << n, of the modes
 *
 *     (K - omega^2 M) v = 0,     V^T M V = E.
 */
struct ModalCoordinates
{
  Eigen::VectorXd omega;                    ///< [m] rad/s, ascending
  Eigen::MatrixXd V;                        ///< [n x m]
  bool            diagonal_damping = false; ///< couplings of modes in V^T B V are omitted
};

} // namespace gestell::coupling
