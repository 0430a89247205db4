#pragma once

#include "apps/scene/read/frame/given_matrices.h"
#include "coupling/exchange/dmig.h"
#include "fem/values/frame_matrices.h"

#include <map>
#include <string>
#include <vector>

namespace gestell::apps
{

/// A node of a frame given by matrices, as its table tells it.
struct TableNode
{
  fem::Interface motions;    ///< name ("": for pictures only), position, rows counted from 0
  std::string    place;      ///< "nodes.csv:12: "
  long           number = 0; ///< in the other program; 0: none
};

struct FrameNodes
{
  std::vector<TableNode> all;
  coupling::NodePlaces   places; ///< [m] of all nodes that have rows; empty unless they and their numbers are known
  /// Axes of nodes that count their motions in others than the global ones, as columns.
  std::map<long, Eigen::Matrix3d> axes;
};

/**
 * Reads the nodes of a frame given by matrices.  `nodes` of [frame] names a table, one line per node, whose head names
 * the columns
 *
 *     name, x [mm], y [mm], z [mm], ux, uy, uz, rx, ry, rz          or          name, node, x [mm], y [mm], z [mm]
 *
 * x, y, z with a unit of length in brackets (that of `file_units` without, m by default); ux ... rz the row of q, from
 * 1, that is this motion, negative where it counts against the axis, empty where there is none; `node` its number,
 * where rows are known by them.  `name` and motions may be left out.  Where rows are known it may be the model of
 * another program as well (read_model_nodes()).  Axes of nodes, and without the key their places, are read from the
 * files of the matrices, where these have nodes; a node that two files name must have one place in both.
 *
 * @param n  rows of the matrices.
 */
FrameNodes read_frame_nodes(const SceneTable &frame, const GivenMatrices &given, Eigen::Index n);

/// What pictures show of the nodes: `triangles`, a table of three or four nodes in each line (by their numbers, or
/// from 1 in the order of the table), and `node_displacements`, a matrix [3 nodes x n] of their displacements in place
/// of the rows of the table.
fem::Picture read_node_picture(const SceneTable &frame, const FrameNodes &nodes, Eigen::Index n);

} // namespace gestell::apps
