#pragma once

#include <Eigen/SparseCore>

#include <cstdint>
#include <string>

namespace gestell::coupling
{

/**
 * Reads a matrix in the binary format of PETSc (MatView on a binary viewer, also PetscBinaryIO of Python and MATLAB),
 * sparse or dense, without PETSc.  All is big-endian:
 *
 *     1211216, rows, columns, entries | entries of each row | column of each entry from 0 | value of each entry
 *
 * with doubles and integers of 4 bytes, or of 8 bytes if PETSc was built with 64-bit indices.  entries = -1 means a
 * dense matrix, its values row by row.
 *
 * @param known_size  number of rows of a matrix read before; this one may have as many rows although it has few entries
 * @throws std::invalid_argument with file, position, found and required value.
 */
Eigen::SparseMatrix<double> read_petsc_matrix(const std::string &file, std::int64_t known_size = 0);

/// Writes a sparse matrix in that format, integers of 4 bytes; PETSc needs no .info file.
/// @throws std::runtime_error if the file cannot be written.
void write_petsc_matrix(const std::string &file, const Eigen::SparseMatrix<double> &A);

/// The same for a dense matrix.
void write_petsc_matrix(const std::string &file, const Eigen::MatrixXd &A);

/// Whether the file begins like an object of PETSc.
bool is_petsc_file(const std::string &file);

} // namespace gestell::coupling
