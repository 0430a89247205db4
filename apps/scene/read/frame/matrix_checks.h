#pragma once

#include "apps/scene/file/scene_table.h"
#include "coupling/exchange/labelled_matrix.h"

#include <Eigen/SparseCore>

#include <string>
#include <vector>

namespace gestell::apps
{

/// "row 5", or "row 5 (node 12, uz)" if that is known.
std::string row_text(Eigen::Index row, const std::vector<coupling::RowLabel> &rows);

/// Reject matrices that no frame can have, with key and row: `key` is that of the matrix, `rows` its rows, if known.
/// @throws std::invalid_argument
void check_symmetry(const SceneTable &frame, const std::string &key, const Eigen::SparseMatrix<double> &A,
                    const std::vector<coupling::RowLabel> &rows);
/// Products of the largest entries must be finite.
void check_magnitude(const SceneTable &frame, const std::string &key, const Eigen::SparseMatrix<double> &A);
void require_positive_diagonal(const SceneTable &frame, const std::string &key, const Eigen::SparseMatrix<double> &A,
                               const std::vector<coupling::RowLabel> &rows);
/// Relative rounding of an entry: half a unit of the tenth digit.
constexpr double least_rounding = 5e-10;
/// The rounding of a matrix in its file, from the entry with the most digits; limited to between that of five and that
/// of ten digits.
double rounding_of(const Eigen::SparseMatrix<double> &A);
/**
 * Rejects a matrix with which some motion has negative energy; coordinates with empty rows are accepted, such as
 * rotations of lumped masses.
 *
 * After scaling to unit diagonal, entries with the relative rounding e change eigenvalues by at most e max_i sum_j
 * |a_ij| (Gershgorin).  A matrix that is semidefinite within this limit is accepted, up to 100 times with a warning.
 */
void check_semidefinite(const SceneTable &frame, const std::string &key, const Eigen::SparseMatrix<double> &A,
                        double rounding, const std::vector<coupling::RowLabel> &rows);
/// Also requires mass or stiffness in each row.
void check_mass(const SceneTable &frame, const Eigen::SparseMatrix<double> &M, double rounding,
                const Eigen::SparseMatrix<double> &C, const std::vector<coupling::RowLabel> &rows);

} // namespace gestell::apps
