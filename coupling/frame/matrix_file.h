#pragma once

#include <Eigen/SparseCore>

#include <cstdint>
#include <string>

namespace gestell::coupling
{

/// Reads a matrix in MatrixMarket or PETSc's binary format, distinguished by the beginning of the file.
/// @param known_size  number of rows of a matrix read before; this one may have as many rows although it has few
///   entries
/// @throws std::invalid_argument as read_matrix_market() and read_petsc_matrix() do.
Eigen::SparseMatrix<double> read_matrix_file(const std::string &file, std::int64_t known_size = 0);

} // namespace gestell::coupling
