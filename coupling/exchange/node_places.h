#pragma once

#include "coupling/exchange/dmig.h"

#include <set>

namespace gestell::coupling
{

/**
 * Reads the places of nodes from the model of another program, in units of the file: GRID cards of Nastran, *NODE of
 * CalculiX and Abaqus (with *INCLUDE and INPUT=), NBLOCK of Ansys (CDWRITE).
 *
 * @param wanted  nodes that have rows; others may be in systems of their own.
 * @return        those of `wanted` that are there.
 * @throws std::invalid_argument with line: a node in two places, a node that counts its place or motions in a system
 *         other than the global one.
 */
NodePlaces read_node_places(const std::string &file, const std::set<long> &wanted);

/// Whether a file has GRID cards, *NODE or NBLOCK.
bool has_node_places(const std::string &file);

} // namespace gestell::coupling
