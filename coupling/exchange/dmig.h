#pragma once

#include "coupling/exchange/labelled_matrix.h"

#include <array>
#include <map>
#include <string>
#include <vector>

namespace gestell::coupling
{

/**
 * Reads all square matrices that DMIG cards of a Nastran file give, by their names in capitals.
 *
 *     DMIG, NAME, 0, IFO, TIN, TOUT, POLAR, , NCOL       IFO 1 square, 6 symmetric; TIN 1, 2 real
 *     DMIG, NAME, GJ, CJ, , G1, C1, A1, , G2, C2, A2 ... entries of column (GJ, CJ)
 *
 * A symmetric matrix contains each pair once.  Rows are in the order of their nodes, then points without a position:
 * component 0, or any component of a point on an SPOINT card.  Rows without entries are omitted. Rectangular matrices
 * (IFO 2, 9: loads) are ignored.
 *
 * Source: MSC Nastran Quick Reference Guide, DMIG.
 *
 * @throws std::invalid_argument with line: complex matrices, entries twice or before the header, components beyond 6,
 *         a file truncated within an entry.
 */
std::map<std::string, LabelledMatrix> read_dmig(const std::string &file);

/// Whether a file has DMIG cards.
bool has_dmig(TextFile &file);

/// Positions of nodes, by their numbers, in units of the file.
using NodePlaces = std::map<long, std::array<double, 3>>;

/**
 * Writes matrices as DMIG cards of large fields (10 digits), their rows as GRID and SPOINT cards before them.
 *
 * @param remark  a comment line.
 * @throws std::runtime_error if the file cannot be written.
 */
void write_dmig(const std::string &file, const std::map<std::string, Eigen::MatrixXd> &matrices,
                const std::vector<RowLabel> &rows, const NodePlaces &places, const std::string &remark);

} // namespace gestell::coupling
