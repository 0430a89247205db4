#pragma once

#include "apps/scene/read/frame/given_matrices.h"
#include "apps/scene/read/frame/read_node_table.h"

#include <vector>

namespace gestell::apps
{

/// Interfaces of a frame given by matrices: nodes that have a name in their table, and [frame.interface.NAME] by
/// `rows`, or by `node` or `position` where rows are known.
std::vector<fem::Interface> read_matrix_interfaces(const SceneTable &frame, const GivenMatrices &given,
                                                   const FrameNodes &nodes, Eigen::Index n);

} // namespace gestell::apps
