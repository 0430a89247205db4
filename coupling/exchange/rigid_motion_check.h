#pragma once

#include "coupling/exchange/dmig.h"

#include <Eigen/Core>

#include <string>

namespace gestell::coupling
{

/**
 * Whether rows and places of a frame belong together, by its rigid motions.
 *
 * R [n x 6] moves and turns all nodes about the origin: displacement e + w x (x - o), rotation w; rows without a place
 * (of modes, s) follow without strain, R_s = -C_ss^-1 C_sb R_b.  Then
 *
 *     C R = 0 in all rows that no support takes part in,
 *     R^T M R = [ m 1, -m [c]x; m [c]x, J ]     with the mass m, its centre c.
 *
 * A node whose forces under the three translations vanish, whatever the places, feels no support; if a row of it does
 * not vanish under a rotation, its place or that of nodes beside it is wrong, or a row of a rotation is missing.
 */
struct RigidMotionCheck
{
  Eigen::MatrixXd       R;                   ///< [n x 6] about `centre`
  Eigen::Vector3d       mass;                ///< [kg] by translations in x, y, z
  Eigen::Vector3d       centre;              ///< [m] of mass; of the nodes, where there is no mass
  std::array<double, 3> lowest{}, highest{}; ///< corners of the box of the nodes [m]
  /// Largest force of a row under a rigid motion, as a share of those that cancel in it: of translations; of rotations
  /// in rows that feel no support.
  double translation_residual = 0., rotation_residual = 0.;
  int    n_rows = 0, n_quiet = 0, n_disturbed = 0; ///< of nodes; of nodes without support; of these moved by a rotation
  int    worst = -1;                               ///< row of rotation_residual
  /// Motions without stiffness by C alone; -1 if that was not counted.
  int n_free = -1;
};

/// @param places  [m] of all nodes in `rows`.
RigidMotionCheck check_rigid_motions(const Eigen::SparseMatrix<double> &M, const Eigen::SparseMatrix<double> &C,
                                     const std::vector<RowLabel> &rows, const NodePlaces &places);

/// R of the three translations [n x 3], which need no places.
Eigen::MatrixXd rigid_translations(const Eigen::SparseMatrix<double> &C, const std::vector<RowLabel> &rows);

/// What was found, for people: mass, centre, residuals.
std::string statement_of(const RigidMotionCheck &check);

/// What speaks against the pairing of rows and places, with the figure; empty if nothing does.
std::string suspicion_of(const RigidMotionCheck &check, const std::vector<RowLabel> &rows);

} // namespace gestell::coupling
