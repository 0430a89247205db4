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
  /// Axes of nodal DOFs, as columns, if not the global ones.
  std::map<long, Eigen::Matrix3d> axes;
};

/// Treatment of nodes with a position in a system missing in the file.
enum class UnknownPlaces
{
  refused,
  left_out ///< their axes are read
};

/**
 * Reads the positions of nodes from the model of another program, in units of the file: GRID cards of Nastran, *NODE of
 * CalculiX and Abaqus (with *INCLUDE and INPUT=), NBLOCK of Ansys (CDWRITE).  Nastran systems must be CORD2R cards of
 * the same file.
 *
 * @param wanted  nodes that have rows; others may be in any system.
 * @return those of `wanted` that exist in the file.
 * @throws std::invalid_argument with line: a node with two positions, a node with position or DOFs in another system.
 */
ModelNodes read_model_nodes(const std::string &file, const std::set<long> &wanted,
                            UnknownPlaces unknown = UnknownPlaces::refused);

std::string place_text(const std::array<double, 3> &x); ///< "[1.2, 0.1, 0] m"

/// Whether a file has GRID cards, *NODE or NBLOCK.
bool has_node_places(const std::string &file);

} // namespace gestell::coupling
