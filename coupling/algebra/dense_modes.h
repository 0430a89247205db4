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
  Eigen::VectorXd omega; // [p] rad/s; 0 for rigid-body modes
  Eigen::MatrixXd V;     // [n x p]
  /// [p] growth [1/s] of exp(growth t) for unstable motions, whose omega is 0.
  Eigen::VectorXd growth;
};

/**
 * All modes of small dense matrices, both symmetric, M positive semidefinite.
 *
 * The solved problem is  M v = mu (C + s M) v,  omega^2 = 1 / mu - s,  so that M may be singular (such coordinates add
 * no mode: p = rank M) and C may be singular (rigid-body modes).  s is below the lowest quotient C_ii / M_ii, and zero
 * if C is regular, which keeps the low frequencies accurate; Rayleigh quotients correct the high ones. If several modes
 * are unresolved far below s (a coordinate with very small mass), s is reduced to them, and the modes are computed
 * again. Unstable motions (v^T C v < 0: the geometric stiffness of a falling linkage) have omega = 0 and sqrt(-omega^2)
 * as their growth; for them s grows.
 *
 * @param cancelled  a mode is a rigid-body mode if v^T C v is at most this share of |v|^T |C| |v| (rounding in C), or
 * of the size of rounding in v.
 * @param n_rigid    number of rigid-body modes if known: they are the lowest modes, and `cancelled` is ignored.
 * @throws std::invalid_argument if a motion has neither stiffness nor mass, with the coordinate, and if an entry is not
 * finite.
 */
DenseModes dense_modes(const Eigen::MatrixXd &C, const Eigen::MatrixXd &M, double cancelled = 1e-12,
                       std::optional<int> n_rigid = {});

} // namespace gestell::coupling
