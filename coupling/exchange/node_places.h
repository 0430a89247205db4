#pragma once

#include "coupling/exchange/dmig.h"

#include <Eigen/Core>

#include <array>
#include <map>
#include <set>
#include <string>

namespace gestell::coupling
{

/// Nodes of a model of another program.
struct ModelNodes
{
  NodePlaces places; ///< in units of the file
  /// Axes in which nodes count their motions, as columns, where these are not the global ones.
  std::map<long, Eigen::Matrix3d> axes;
};

/// What comes of nodes whose place counts in a system that the file does not give.
enum class UnknownPlaces
{
  refused,
  left_out ///< their axes are read
};

/**
 * Reads the places of nodes from the model of another program, in units of the file: GRID cards of Nastran, *NODE of
 * CalculiX and Abaqus (with *INCLUDE and INPUT=), NBLOCK of Ansys (CDWRITE).  Systems of Nastran that count are those
 * of CORD2R cards in the same file.
 *
 * @param wanted  nodes that have rows; others may be in systems of their own.
 * @return        those of `wanted` that are there.
 * @throws std::invalid_argument with line: a node in two places, a node that counts its place or motions in another
 *         system.
 */
ModelNodes read_model_nodes(const std::string &file, const std::set<long> &wanted,
                            UnknownPlaces unknown = UnknownPlaces::refused);

std::string place_text(const std::array<double, 3> &x); ///< "[1.2, 0.1, 0] m"

/// Whether a file has GRID cards, *NODE or NBLOCK.
bool has_node_places(const std::string &file);

} // namespace gestell::coupling
