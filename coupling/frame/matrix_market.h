#pragma once

#include <Eigen/SparseCore>

#include <cstdint>
#include <string>

namespace gestell::coupling
{

/**
 * Reads a matrix in the exchange format MatrixMarket: coordinate or array, real or integer, general or symmetric.  A
 * symmetric file contains one triangle; both are returned. A duplicate entry is an error. Fortran exponents (D) are
 * allowed.
 *
 * @param known_size  number of rows of a matrix read before; this one may have as many rows although it has few entries
 * @throws std::invalid_argument with file and line, the offending text and what was expected.
 */
Eigen::SparseMatrix<double> read_matrix_market(const std::string &file, std::int64_t known_size = 0);

enum class Symmetry
{
  general,
  symmetric ///< only the lower triangle is written
};

/// Writes in coordinate form with all digits; entries column by column.  `remark` becomes a comment.
/// @throws std::runtime_error if the file cannot be written.
void write_matrix_market(const std::string &file, const Eigen::SparseMatrix<double> &A, Symmetry symmetry,
                         const std::string &remark = {});

/// Writes a dense matrix in array form, with all digits.
void write_matrix_market(const std::string &file, const Eigen::MatrixXd &A, const std::string &remark = {});

} // namespace gestell::coupling
