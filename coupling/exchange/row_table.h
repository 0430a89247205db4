#pragma once

#include "coupling/exchange/labelled_matrix.h"

namespace gestell::coupling
{

/**
 * Reads the labels of matrix rows, one line per row:
 *
 *     12.3          node and direction, as CalculiX writes .dof
 *     5  12  UZ     row, node and motion, as Ansys writes .mapping (HBMAT with Mapping = YES), below a title
 *
 * DOFs of Ansys are UX UY UZ ROTX ROTY ROTZ.
 *
 * @throws std::invalid_argument with line: other DOFs, duplicate or missing rows.
 */
std::vector<RowLabel> read_row_table(const std::string &file);

} // namespace gestell::coupling
