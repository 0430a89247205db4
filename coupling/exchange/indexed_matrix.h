#pragma once

#include "coupling/exchange/labelled_matrix.h"

namespace gestell::coupling
{

/**
 * Reads lines `row column value`, as CalculiX writes .sti and .mas (*FREQUENCY, SOLVER=MATRIXSTORAGE): from 1, one
 * triangle, either of them.  The row table is in a separate file (read_row_table()).
 *
 * @throws std::invalid_argument with line: row numbers impossible for a file of its length, duplicate entries.
 */
LabelledMatrix read_indexed_matrix(const std::string &file);

/// Whether a file begins with such a line.
bool is_indexed_matrix(TextFile &file);

} // namespace gestell::coupling
