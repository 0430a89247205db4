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
/// By how much an entry may be rounded, as a share of it: half a unit of ten digits and more.
constexpr double least_rounding = 5e-10;
/// The same of a matrix as its file has it, by the digits of the entry that has most; no less than that of ten digits
/// and no more than that of five.
double rounding_of(const Eigen::SparseMatrix<double> &A);
/**
 * Refuses a matrix by which some motion has negative energy; coordinates without an own entry may be, as rotations of
 * lumped masses are.
 *
 * Scaled to unit diagonal, entries rounded by a share e move its eigenvalues by no more than e max_i sum_j |a_ij|
 * (Gershgorin).  A matrix that is semidefinite within that is taken, up to a hundred times as much with a warning.
 */
void check_semidefinite(const SceneTable &frame, const std::string &key, const Eigen::SparseMatrix<double> &A,
                        double rounding, const std::vector<coupling::RowLabel> &rows);
/// Besides, each row needs mass or stiffness.
void check_mass(const SceneTable &frame, const Eigen::SparseMatrix<double> &M, double rounding,
                const Eigen::SparseMatrix<double> &C, const std::vector<coupling::RowLabel> &rows);

} // namespace gestell::apps
