#pragma once

#include <Eigen/Core>

#include <functional>

namespace gestell::coupling
{

/**
 * The derivative Phi of a period [2n x 2n] where tangents cost more than the motion, of motions in the norm of energy.
 *
 * A period leaves little of most motions of a frame.  The first matrix is complete; of the next ones only the images of
 * the right singular vectors V that had singular values above left_out are computed, Phi = (Phi V) V^T, and that of a
 * random direction across them, which shows whether they are still all: else the matrix is complete again.
 */
class PassageDerivative
{
public:
  static constexpr double left_out = 0.01; ///< of itself that a period leaves of a motion: less is neglected

  /// Images [2n x k] of directions [2n x k] from which joints have taken what they do not allow.
  using Map = std::function<Eigen::MatrixXd(const Eigen::MatrixXd &)>;

  Eigen::MatrixXd monodromy(Eigen::Index size, const Map &map);
  /// Whether the last one was not complete.
  bool is_condensed() const { return condensed_; }

private:
  Eigen::MatrixXd V_; ///< of the last one [2n x k]
  bool            condensed_ = false;
};

} // namespace gestell::coupling
