#pragma once

#include <Eigen/Core>

#include <functional>
#include <string>

namespace gestell::coupling
{

/**
 * The derivative Phi of a passage where its integrator has no tangents, by differences of passages:
 *
 *     Phi d = (P(z + delta d) - P(z))/delta,     d = (N(z + delta x) - N(z))/delta,
 *
 * z = (Omega q, q') [2n], P its end, N the nearest start that the joints allow; delta is reduced until both passages
 * have the same events.  Differences are taken for directions D [2n x k] that span what a period leaves large, Phi =
 * (Phi D) D^+.  D begins with that of the last call and a random direction, and grows by the residual of the worst Ritz
 * vector (Arnoldi) until
 *
 *     |Phi y - mu y| <= 0.01 |y|        for |mu| > share, <= share |y| for the others,
 *     |Phi y - mu y| <= 0.1 ||mu| - 1|  for those that decide on the stability; at most as far as differences are
 * exact.
 *
 * Source: Saad, Numerical Methods for Large Eigenvalue Problems, 2011, chapters 4 to 6.
 */
class PassageDifferences
{
public:
  static constexpr double share =
      0.1; ///< of itself that a motion keeps over a period; those that keep less are left out

  static constexpr double step =
      1e-4; ///< of the motion: curvature, and jumps between grids of fixed steps, leave as much

  /// The end of a passage, and its events in their order.
  struct End
  {
    Eigen::VectorXd z;
    std::string     events{};
  };
  using Passage = std::function<End(const Eigen::VectorXd &)>;
  using Map     = std::function<Eigen::VectorXd(const Eigen::VectorXd &)>;

  /// Phi [2n x 2n].
  /// @param end      P(z)
  /// @param sizes    that of the motion, by coordinates of z
  /// @param passage  P
  /// @param nearest  N
  Eigen::MatrixXd monodromy(const Eigen::VectorXd &z, const End &end, const Eigen::VectorXd &sizes,
                            const Passage &passage, const Map &nearest);
  /// Images [2n x k] of directions x [2n x k].
  Eigen::MatrixXd images(const Eigen::VectorXd &z, const End &end, const Eigen::VectorXd &sizes, const Passage &passage,
                         const Map &nearest, const Eigen::MatrixXd &x);

  const Eigen::MatrixXd &directions() const { return directions_; } ///< that a period leaves large [2n x k]
  void                   begin_with(const Eigen::MatrixXd &directions) { directions_ = directions; }

private:
  class Space;

  Eigen::MatrixXd directions_;
};

} // namespace gestell::coupling
