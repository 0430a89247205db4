#pragma once

#include "apps/scene/file/scene_table.h"
#include "coupling/exchange/labelled_matrix.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace gestell::apps
{

/// Mass, stiffness and damping of [frame] in SI, and the meaning of their rows.
struct GivenMatrices
{
  Eigen::SparseMatrix<double>                M, C;
  std::optional<Eigen::SparseMatrix<double>> B;           ///< if `damping` is a matrix
  std::vector<coupling::RowLabel>            rows{};      ///< [n], or empty: only row numbers are known
  double                                     length = 1.; ///< [m] length unit of the other program's files
  std::vector<std::string>                   models{};    ///< files of the matrices that also contain nodes
  std::vector<std::string>                   statements{};
};

/**
 * Reads `mass`, `stiffness` and `damping`, each given in rows or by a file in any format of coupling/exchange, with
 * `matrix_names`, `rows` and `file_units`.
 *
 * If the rows of all matrices are known, the result has the rows of the stiffness, then further ones of mass and
 * damping; rows missing in a file are zero.  Units: with l, m, t, f those of the file, a displacement has the unit l, a
 * rotation rad, and a coordinate without a position l sqrt(m), so that modes of unit mass keep unit mass; matrices
 * written in the scene are in SI:
 *
 *     q_file = S q,   M = m l^2 S M_file S,   B = f l t S B_file S,   C = f l S C_file S,
 *     S_ii = 1/l, 1, 1 / (l sqrt(m)).
 *
 * All matrices are symmetric; mass and damping are positive semidefinite.
 */
GivenMatrices read_given_matrices(const SceneTable &frame);

/**
 * Transforms the rows of nodes with local axes (columns of E) to the global axes: u = E u', A = G A' G^T, with all E in
 * G.
 *
 * @throws std::invalid_argument  if such a node has only one or two displacements or rotations.
 */
void turn_to_global(const SceneTable &frame, const std::map<long, Eigen::Matrix3d> &axes, GivenMatrices &given);

/// A matrix given in rows or by a MatrixMarket or PETSc file, unchanged.
Eigen::SparseMatrix<double> read_plain_matrix(const SceneTable &frame, const std::string &key, const Kind &kind);

/// "3 x 4"
std::string shape_text(Eigen::Index rows, Eigen::Index columns);

} // namespace gestell::apps
