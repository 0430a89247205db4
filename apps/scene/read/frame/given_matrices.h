#pragma once

#include "apps/scene/file/scene_table.h"
#include "coupling/exchange/labelled_matrix.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace gestell::apps
{

/// Mass, stiffness and damping of [frame] in SI, and what their rows are.
struct GivenMatrices
{
  Eigen::SparseMatrix<double>                M, C;
  std::optional<Eigen::SparseMatrix<double>> B;           ///< of `damping` as a matrix
  std::vector<coupling::RowLabel>            rows{};      ///< [n], or empty: numbers alone
  double                                     length = 1.; ///< [m] that files of the other program count places in
  std::vector<std::string>                   models{};    ///< files of the matrices that have nodes as well
  std::vector<std::string>                   statements{};
};

/**
 * Reads `mass`, `stiffness` and `damping`, each given in rows or by a file in any format of coupling/exchange, with
 * `matrix_names`, `rows` and `file_units`.
 *
 * Where the rows of all are known, theirs are those of the stiffness, then others of mass and damping; rows that a file
 * leaves out are zero.  Units: with l, m, t, f those of the file, a displacement counts in l, a rotation in rad, a
 * coordinate without a place in l sqrt(m), which leaves modes with unit mass such ones; matrices written in the scene
 * are in SI as they stand:
 *
 *     q_file = S q,   M = m l^2 S M_file S,   B = f l t S B_file S,   C = f l S C_file S,
 *     S_ii = 1/l, 1, 1 / (l sqrt(m)).
 *
 * Each of the matrices is symmetric; mass and damping have no motion of negative energy.
 */
GivenMatrices read_given_matrices(const SceneTable &frame);

/**
 * Turns the rows of nodes that count their motions along axes of their own, E as columns, to the global ones: u = E u',
 * A = G A' G^T with G of all E.
 *
 * @throws std::invalid_argument  if such a node has one or two of three displacements or rotations.
 */
void turn_to_global(const SceneTable &frame, const std::map<long, Eigen::Matrix3d> &axes, GivenMatrices &given);

/// A matrix in rows or in a MatrixMarket or PETSc file, as it stands.
Eigen::SparseMatrix<double> read_plain_matrix(const SceneTable &frame, const std::string &key, const Kind &kind);

/// "3 x 4"
std::string shape_text(Eigen::Index rows, Eigen::Index columns);

} // namespace gestell::apps
