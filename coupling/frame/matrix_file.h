#pragma once

#include <Eigen/SparseCore>

#include <string>

namespace gestell::coupling
{

/// Reads a matrix in MatrixMarket or PETSc's binary format, told apart by what the file begins with.
/// @throws std::invalid_argument as read_matrix_market() and read_petsc_matrix().
Eigen::SparseMatrix<double> read_matrix_file(const std::string &file);

} // namespace gestell::coupling
