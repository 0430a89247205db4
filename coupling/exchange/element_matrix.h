#pragma once

#include "coupling/exchange/labelled_matrix.h"

#include <string>

namespace gestell::coupling
{

/**
 * Reads the matrices of a substructure as CalculiX (*SUBSTRUCTURE MATRIX OUTPUT) and Abaqus write them, by their types
 * in capitals, STIFFNESS and MASS:
 *
 *     *USER ELEMENT, NODES=2, LINEAR
 *     ** ELEMENT NODES
 *     ** 11, 12
 *     1, 2, 3               directions of the first node,
 *     2, 1, 2               of the second, and so on; as before where there is no line
 *     *MATRIX, TYPE=STIFFNESS
 *     lower triangle, row by row
 *
 * CalculiX lists a node for every direction.
 *
 * @throws std::invalid_argument with line.
 */
std::map<std::string, LabelledMatrix> read_element_matrices(const std::string &file);

/// Whether a file has a line *MATRIX, TYPE=....
bool has_element_matrix(TextFile &file);

} // namespace gestell::coupling
