#pragma once

#include "apps/scene/file/scene_table.h"
#include "fem/values/frame_matrices.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// A node of a frame given by matrices, as its table tells it.
struct TableNode
{
  fem::Interface motions; ///< name ("": for pictures only), position, rows counted from 0
  std::string    place;   ///< "nodes.csv:12: "
};

/**
 * Reads the table that `nodes` of [frame] names: one line per node, the head names the columns
 *
 *     name, x [mm], y [mm], z [mm], ux, uy, uz, rx, ry, rz
 *
 * x, y, z with a unit of length in brackets (m without); ux ... rz the row of q, from 1, that is this motion, negative
 * where it counts against the axis, empty where there is none.  `name` and motions may be left out.  None if there is
 * no key.
 *
 * @param n  rows of the matrices.
 */
std::vector<TableNode> read_node_table(const SceneTable &frame, Eigen::Index n);

/// What pictures show of the nodes: `triangles`, a table of three or four nodes in each line (from 1, in the order of
/// the table), and `node_displacements`, a matrix [3 nodes x n] of their displacements in place of the rows of the
/// table.
fem::Picture read_node_picture(const SceneTable &frame, const std::vector<TableNode> &nodes, Eigen::Index n);

} // namespace gestell::apps
