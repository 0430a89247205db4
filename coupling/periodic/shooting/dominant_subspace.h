#pragma once

#include "coupling/integration/propagation/modal_blocks.h"
#include "coupling/periodic/periodic_problem.h"

#include <vector>

namespace gestell::coupling
{

/**
 * The matrix of shooting without the tangents of fast-decaying motions.
 *
 * In the modes of the base system, x = from_q q + from_v q', a block with less than a share left after a period is
 * fast, all others (and free motions) are slow. Tangents are integrated for the slow ones only,
 *
 *     Phi_x = [Phi_ss  0; Phi_fs  e^(Lambda_f T)],
 *
 * which omits the effect of fast motions through the forces of the elements; Newton's method corrects it by more steps.
 * Exact where all blocks are slow.
 *
 * Source: Lust, Roose, Spence, Champneys, An adaptive Newton-Picard algorithm with subspace iteration for computing
 * periodic solutions, SIAM J. Sci. Comput. 19 (1998); the fast block here is that of the base system.
 */
class DominantSubspace
{
public:
  /// Unknowns are z = (Omega q, q') of ShootingEquations, Omega that of the problem's period.
  /// @throws std::invalid_argument as modal_blocks()
  explicit DominantSubspace(const PeriodicProblem &problem);

  /// Motions with less than `share` left after `period` are fast, except the slowest of all.
  void   choose(double share, double period);
  bool   formed() const { return newton_.size() > 0; }
  bool   all() const { return int(slow_.size()) == 2 * modes_.n_modal; }
  int    size() const { return int(slow_.size()); }
  double share() const { return share_; }

  /// Tangents to integrate, dq and dv [n x size()].
  Eigen::MatrixXd dq() const { return modes_.Q(Eigen::all, slow_); }
  Eigen::MatrixXd dv() const { return modes_.V(Eigen::all, slow_); }

  /// Their images [2n x size()], and d(q, q')(T)/dT [2n]; the latter is read where the period is unknown.
  void take(const Eigen::MatrixXd &images, const Eigen::VectorXd &rate);
  /// dz by which Newton's method goes back, for the residual r(z) of ShootingEquations.
  Eigen::VectorXd correction(const Eigen::VectorXd &residual) const;
  /// Orthonormal in z: what belongs to the multipliers of Phi_ss that are above the share, at least to the largest
  /// [2n x k].
  Eigen::MatrixXd dominant() const;

private:
  Eigen::MatrixXd from_modes(const Eigen::MatrixXd &x) const; ///< z
  Eigen::MatrixXd to_modes(const Eigen::MatrixXd &z) const;   ///< x of the modal blocks

  const PeriodicProblem    &problem_;
  double                    omega_, share_ = 0.;
  ModalBlocks               modes_;
  std::vector<Eigen::Index> slow_, fast_; ///< states of x
  Eigen::MatrixXd           phi_;         ///< Phi_x [2n x 2n]
  Eigen::MatrixXd           newton_;      ///< Phi_x - E, bordered where the period is unknown
};

/// Chooses the usual share; whether the system is large and more than half of its modes decay fast, so that
/// shoot_slow() pays.
bool mostly_fast(DominantSubspace &motions, const PeriodicProblem &problem);

/// The largest multipliers by Rayleigh and Ritz, from the images of a space that every passage improves.
class LargestMultipliers
{
public:
  LargestMultipliers(Eigen::MatrixXd space, double omega) : omega_(omega), Z_(std::move(space)) {}

  Eigen::MatrixXd dq() const { return Z_.topRows(Z_.rows() / 2) / omega_; }
  Eigen::MatrixXd dv() const { return Z_.bottomRows(Z_.rows() / 2); }
  /// Images [2n x k] of dq, dv, which span the next space.
  void take(Eigen::MatrixXd images);
  /// Whether the largest ones have converged.
  bool converged() const { return converged_; }
  /// Those whose motions are kept to themselves, largest first.
  Eigen::VectorXcd values() const;
  double           leaves() const { return leaves_; } ///< largest residual of those that decide

private:
  double           omega_;
  Eigen::MatrixXd  Z_;
  Eigen::VectorXcd values_;
  Eigen::VectorXd  residuals_;
  double           leaves_    = 1.;
  bool             converged_ = false;
};

} // namespace gestell::coupling
