#pragma once

#include "coupling/exchange/labelled_matrix.h"

namespace gestell::coupling
{

/**
 * Reads a matrix in Harwell-Boeing format, as Ansys writes it (HBMAT with Form = ASCII): assembled and real, symmetric
 * (RSA, one triangle) or not (RUA).  A following right-hand side is ignored. The row table is in a separate file
 * (read_row_table()).
 *
 * Source: Duff, Grimes and Lewis, Users' Guide for the Harwell-Boeing Sparse Matrix Collection, TR/PA/92/86, 1992.
 *
 * Column widths are those of the header; numbers may touch.
 *
 * @throws std::invalid_argument with line: complex, pattern and element matrices, sizes that do not fit the file.
 */
LabelledMatrix read_harwell_boeing(const std::string &file);

/// Whether the third line of a file has this format.
bool is_harwell_boeing(TextFile &file);

} // namespace gestell::coupling
