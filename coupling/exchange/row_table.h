#pragma once

#include "coupling/exchange/labelled_matrix.h"

namespace gestell::coupling
{

/**
 * Reads what the rows of a matrix are, one line a row:
 *
 *     12.3          node and direction, as CalculiX writes .dof
 *     5  12  UZ     row, node and motion, as Ansys writes .mapping (HBMAT with Mapping = YES), below a title
 *
 * Motions of Ansys are UX UY UZ ROTX ROTY ROTZ.
 *
 * @throws std::invalid_argument with line: other motions, rows that are there twice or not at all.
 */
std::vector<RowLabel> read_row_table(const std::string &file);

} // namespace gestell::coupling
