#pragma once

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace gestell::coupling
{

/// `cancelled` of dense_modes() for the matrices of a reduction, whose C*_11 is the difference of far larger ones.
constexpr double cancelled_by_reduction = 1e-10;

/// Undamped modes (C - omega^2 M) v = 0, omega ascending, V^T M V = E.
struct DenseModes
{
  Eigen::VectorXd omega; // [p] rad/s; rigid motions have 0
  Eigen::MatrixXd V;     // [n x p]
  /// [p] 1/s, of exp(growth t): motions that C drives away, whose omega is 0.
  Eigen::VectorXd growth;
};

/**
 * All modes of small dense matrices, both symmetric, M positive semidefinite.
 *
 * Solved is  M v = mu (C + s M) v,  omega^2 = 1 / mu - s,  so that M may be singular (such coordinates have no mode of
 * their own: p = rank M) and C may be singular (rigid motions).  s lies below the lowest quotient C_ii / M_ii and is
 * zero if C is regular, which keeps the low frequencies accurate; Rayleigh quotients mend the high ones.  Where they
 * show several modes so far below s that it cannot tell them apart (a coordinate has hardly any mass), s falls to
 * them, and the modes are taken again.  Motions that C drives away (v^T C v < 0: the geometric stiffness of a linkage
 * about to fall) have omega = 0 and sqrt(-omega^2) as their growth; for them s grows.
 *
 * @param cancelled  a mode is a rigid motion if v^T C v is no more than this share of |v|^T |C| |v|, its terms without
 * their signs: what rounding in C leaves; or no more than rounding in v leaves.
 * @param n_rigid    number of rigid motions where it is known: they are the lowest modes, and `cancelled` has no say.
 * @throws std::invalid_argument if a motion has neither stiffness nor mass, naming the coordinate it fails at, and if
 * an entry is not finite.
 */
DenseModes dense_modes(const Eigen::MatrixXd &C, const Eigen::MatrixXd &M, double cancelled = 1e-12,
                       std::optional<int> n_rigid = {});

} // namespace gestell::coupling
