#pragma once

#include "fem/assembly/cell_parts.h"
#include "fem/values/frame_matrices.h"
#include "fem/values/sparse_matrix.h"

#include <Eigen/Core>

#include <functional>
#include <string>
#include <vector>

namespace gestell::coupling
{

/// A part of a frame before its reduction.
struct PartOfFrame
{
  fem::PartMatrices sums; ///< of cells, foundations and masses
  /// [n_p x n_p] damping that differs from alpha M + beta C: foundations, less the share of Rayleigh that they and
  /// masses do not have.
  fem::SparseMatrix             damping;
  double                        alpha = 0.; ///< [1/s] of Rayleigh damping
  Eigen::MatrixXd               load;       // [n_p x 3] of a unit acceleration
  std::vector<fem::FrameOutput> forces;     ///< of supports and sections, of which the interior counts
  std::vector<int>              held;       ///< interface: coordinates of other parts or of the mechanism, ascending
  std::string                   name;       ///< "part 2 of 3", for messages
  std::string                   prestress;  ///< place of the loads that sums.C is about, or empty
  /// Assembles sums.C again, which makes room for other memory meanwhile.
  std::function<fem::SparseMatrix()> stiffness;
};

/**
 * A part in its interface coordinates q_1 [n1] and its lowest fixed-interface modes [m].  The constraint modes Psi
 * [n_p x n1] are never stored: eliminating the interior from C - lambda M leaves
 *
 *     S(lambda) = C* - lambda M* - lambda^2 sum m_j m_j^T / (omega_j^2 - lambda),
 *
 * so that three eliminations and the retained modes give M* except for a small multiple of the flexibility of the
 * truncated modes: docs/theory/substructures.md (9).
 */
struct CondensedPart
{
  Eigen::MatrixXd C, M;    // [n1 x n1], lower triangles: Psi^T C Psi, Psi^T M Psi
  Eigen::MatrixXd M_1V;    // [n1 x m]  Psi^T M V, column j is m_j
  Eigen::MatrixXd damping; // [(n1+m) x (n1+m)] of PartOfFrame::damping, or empty: none
  Eigen::MatrixXd load;    // [(n1+m) x 3] of the interior
  /// Column k: on_q, on_v, on_a of PartOfFrame::forces [n1+m each] and under_acceleration [3], with the static answer
  /// of the part beyond its modes, docs/theory/reduction.md (7a).
  Eigen::MatrixXd forces;
  Eigen::MatrixXd V;          // [n_p x m], V^T M V = E, zero at the interface
  Eigen::VectorXd omega;      // [m] rad/s, ascending
  double          sigma = 0.; ///< [1/s^2] M* lacks sigma F at most, F the flexibility of the truncated modes
};

/// Number of fixed-interface modes below a frequency [rad/s].
int modes_below(const PartOfFrame &part, double omega);

/// The modes are counted by the inertia of C - omega^2 M where C has an entry wherever M has one.
/// @throws std::invalid_argument if the part moves freely with its interface fixed; ConvergenceFailure.
CondensedPart condense(PartOfFrame part, int n_modes);

/// Fields of a part that follow from those of the joined frame.
struct RecoveredPart
{
  Eigen::MatrixXd T;        // [n_p x k]
  Eigen::MatrixXd beyond;   // [n_p x 3] static deflection outside the basis
  Eigen::VectorXd left_out; // [p] q_1^T F q_1 of each mode
};

/// @param X       [(n1+m) x k] columns of the joined frame in the coordinates of the part.
/// @param beyond  [(n1+m) x 3] the same of the static deflection outside the basis.
/// @param modes   [k x p] modes of the frame in its reduced coordinates.
RecoveredPart recover(PartOfFrame part, const CondensedPart &condensed, const Eigen::MatrixXd &X,
                      const Eigen::MatrixXd &beyond, const Eigen::MatrixXd &modes);

/// A part under static loads f, its interior in equilibrium:  C* q_1 = f* + reactions.
struct StaticPart
{
  Eigen::MatrixXd C;    // [n1 x n1], lower triangle: C11 - C12 C22^-1 C21
  Eigen::VectorXd load; // [n1]  -C12 C22^-1 f2
};

/// @param f  [n_p] of which only the interior counts: loads on the interface belong to no part.
StaticPart      condense_statics(const PartOfFrame &part, Eigen::VectorXd f);
Eigen::VectorXd recover_statics(const PartOfFrame &part, Eigen::VectorXd f, const Eigen::VectorXd &q1);

} // namespace gestell::coupling
