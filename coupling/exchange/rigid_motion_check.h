#pragma once

#include "coupling/exchange/dmig.h"

#include <Eigen/Core>

#include <string>

namespace gestell::coupling
{

/**
 * Checks rows against positions of a frame by its rigid-body modes. R [n x 6] translates and rotates all nodes about
 * the origin: displacement e + w x (x - o), rotation w; rows without a position (of modes, s) follow without strain,
 * R_s = -C_ss^-1 C_sb R_b.  Then C R = 0 in all rows without support, R^T M R = [ m 1, -m [c]x; m [c]x, J ]     with
 * the mass m, its centre c.
 *
 * A node without forces under the three translations is unsupported; if a row of it does not vanish under a rotation,
 * its position or that of neighbouring nodes is wrong, or a row of a rotation is missing.
 */
struct RigidMotionCheck
{
  Eigen::MatrixXd       R;                   ///< [n x 6] about `centre`
  Eigen::Vector3d       mass;                ///< [kg] by translations in x, y, z
  Eigen::Vector3d       centre;              ///< [m] of mass; of the nodes, where there is no mass
  std::array<double, 3> lowest{}, highest{}; ///< corners of the box of the nodes [m]
  /// Largest force of a row under a rigid motion, relative to those that cancel in it: of translations; of rotations in
  /// unsupported rows.
  double translation_residual = 0., rotation_residual = 0.;
  int    n_rows = 0, n_quiet = 0, n_disturbed = 0; ///< of nodes; of nodes without support; of these moved by a rotation
  int    worst = -1;                               ///< row of rotation_residual
  /// Number of motions without stiffness by C only; -1 if not counted.
  int n_free = -1;
};

/// @param places  [m] of all nodes in `rows`.
RigidMotionCheck check_rigid_motions(const Eigen::SparseMatrix<double> &M, const Eigen::SparseMatrix<double> &C,
                                     const std::vector<RowLabel> &rows, const NodePlaces &places);

/// R of the three translations [n x 3], which need no positions.
Eigen::MatrixXd rigid_translations(const Eigen::SparseMatrix<double> &C, const std::vector<RowLabel> &rows);

/// Text of the result: mass, centre, residuals.
std::string statement_of(const RigidMotionCheck &check);

/// Warning of a mismatch of rows and positions, with the value; empty if none.
std::string suspicion_of(const RigidMotionCheck &check, const std::vector<RowLabel> &rows);

} // namespace gestell::coupling
