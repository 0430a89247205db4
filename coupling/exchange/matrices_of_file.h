#pragma once

#include "coupling/exchange/labelled_matrix.h"

#include <map>
#include <string>

namespace gestell::coupling
{

/**
 * All matrices of a file, by name; "" for a matrix without a name. Formats are distinguished by content:
 * DMIG of Nastran, *MATRIX of CalculiX and Abaqus, Harwell-Boeing, lines `row column value`, else MatrixMarket or
 * PETSc's binary format.
 *
 * @param known_size  number of rows of a matrix read before; this one may have as many rows although it has few entries
 * @throws std::invalid_argument from their readers.
 */
std::map<std::string, LabelledMatrix> matrices_of_file(const std::string &file, std::int64_t known_size = 0);

/// Role of a matrix of a frame.
enum class MatrixRole
{
  mass,
  damping,
  stiffness
};

/**
 * The matrix of a role: of name `asked`, or without it the one identified by its name (MAAX, BAAX, KAAX;
 * MASS, STIFFNESS; the only one that begins with M, B or K).
 *
 * @throws std::invalid_argument  with the available names.
 */
const LabelledMatrix &matrix_for(const std::map<std::string, LabelledMatrix> &matrices, MatrixRole role,
                                 const std::string &requested, const std::string &file);

} // namespace gestell::coupling
