#pragma once

#include "apps/scene/read/frame/given_matrices.h"
#include "coupling/exchange/dmig.h"
#include "fem/values/frame_matrices.h"

#include <map>
#include <string>
#include <vector>

namespace gestell::apps
{

/// A node of a frame given by matrices, from its table.
struct TableNode
{
  fem::Interface motions;    ///< name ("": only for pictures), position, rows counted from 0
  std::string    place;      ///< "nodes.csv:12: "
  long           number = 0; ///< in the other program; 0: none
};

struct FrameNodes
{
  std::vector<TableNode> all;
  coupling::NodePlaces   places; ///< [m] of all nodes that have rows; empty unless they and their numbers are known
  /// Local axes of nodes whose motions are not in global axes, as columns.
  std::map<long, Eigen::Matrix3d> axes;
};

/**
 * Reads the nodes of a frame given by matrices.  `nodes` of [frame] names a table, one line per node, with a header of
 * columns
 *
 *     name, x [mm], y [mm], z [mm], ux, uy, uz, rx, ry, rz          or          name, node, x [mm], y [mm], z [mm]
 *
 * x, y, z have a unit of length in brackets (without one that of `file_units`, m by default). ux ... rz are the row of
 * q, from 1, that is this motion; negative if it is opposite to the axis, empty if there is none. `node` is its number,
 * if rows are identified by node numbers. `name` and motions are optional. If rows are known, the file may also be the
 * model of another program (read_model_nodes()). Axes of nodes, and without the key `nodes` their positions, are read
 * from the files of the matrices, if these contain nodes; a node in two files must have the same position in both.
 *
 * @param n  number of rows of the matrices.
 */
FrameNodes read_frame_nodes(const SceneTable &frame, const GivenMatrices &given, Eigen::Index n);

/// Pictures of the nodes: `triangles`, a table with three or four nodes in each line (by their numbers, or counted from
/// 1 in the order of the table), and `node_displacements`, a matrix [3 nodes x n] of their displacements, which
/// replaces the rows of the table.
fem::Picture read_node_picture(const SceneTable &frame, const FrameNodes &nodes, Eigen::Index n);

} // namespace gestell::apps
