#pragma once

#include "coupling/integration/system/linear_system.h"

#include <Eigen/Core>

#include <functional>

namespace gestell::coupling
{

/// Roots of the energies of unit motions q, q' [2n], by the diagonals of M and C: in their norm a frame that vibrates
/// freely does not grow.
Eigen::VectorXd energy_roots(const LinearSystem &linear, double omega);

/**
 * The derivative Phi of a period [2n x 2n] where tangents cost more than the motion, of motions in the norm of energy.
 *
 * A period leaves little of most motions of a frame.  The first matrix is complete; of the next ones only the images of
 * the right singular vectors V that had singular values above left_out are computed: with D, what the joints here leave
 * of V, Phi = (Phi D) D^+.  The image of a random direction shows whether that is still all: else the matrix is
 * complete again.
 */
class PassageDerivative
{
public:
  static constexpr double left_out = 0.01; ///< of itself that a period leaves of a motion: less is neglected

  /// What the joints leave of directions, and the images of that [2n x k].
  struct Images
  {
    Eigen::MatrixXd directions, images;
  };
  using Map = std::function<Images(const Eigen::MatrixXd &)>;

  Eigen::MatrixXd monodromy(Eigen::Index size, const Map &map);
  /// Whether the last one was not complete.
  bool is_condensed() const { return condensed_; }
  /// The next one is complete.
  void begin_anew() { V_.resize(0, 0); }

private:
  Eigen::MatrixXd V_; ///< of the last one [2n x k]
  bool            condensed_ = false;
  unsigned        calls_     = 0;
};

} // namespace gestell::coupling
