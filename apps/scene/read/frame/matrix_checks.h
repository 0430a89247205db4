#pragma once

#include "apps/scene/file/scene_table.h"
#include "coupling/exchange/labelled_matrix.h"

#include <Eigen/SparseCore>

#include <string>
#include <vector>

namespace gestell::apps
{

/// "row 5", or "row 5 (node 12, uz)" where that is known.
std::string row_text(Eigen::Index row, const std::vector<coupling::RowLabel> &rows);

/// Refuse what no frame has, with the key and the row: `key` is that of the matrix, `rows` what its rows are, if known.
/// @throws std::invalid_argument
void check_symmetry(const SceneTable &frame, const std::string &key, const Eigen::SparseMatrix<double> &A,
                    const std::vector<coupling::RowLabel> &rows);
/// Products of the largest entries must stay numbers.
void check_magnitude(const SceneTable &frame, const std::string &key, const Eigen::SparseMatrix<double> &A);
void require_positive_diagonal(const SceneTable &frame, const std::string &key, const Eigen::SparseMatrix<double> &A,
                               const std::vector<coupling::RowLabel> &rows);
/// Refuses a matrix by which some motion has negative energy; coordinates without an own entry may be, as rotations of
/// lumped masses are.  Scaled to unit diagonal it must have no eigenvalue below -1e-9.
void check_semidefinite(const SceneTable &frame, const std::string &key, const Eigen::SparseMatrix<double> &A,
                        const std::vector<coupling::RowLabel> &rows);
/// Besides, each row needs mass or stiffness.
void check_mass(const SceneTable &frame, const Eigen::SparseMatrix<double> &M, const Eigen::SparseMatrix<double> &C,
                const std::vector<coupling::RowLabel> &rows);

} // namespace gestell::apps
