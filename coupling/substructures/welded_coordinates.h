#pragma once

#include "coupling/substructures/frame_of_parts.h"
#include "coupling/substructures/part_union.h"

#include <Eigen/Core>

#include <vector>

namespace gestell::coupling
{

/// q = G q_j: at welds and contacts the second interface moves with the first.
struct WeldedCoordinates
{
  Eigen::MatrixXd  G;    // [n x n_j]
  std::vector<int> kept; ///< [n] column of a coordinate of q in G, -1: it is eliminated
};

/// Rows of the union that stay coordinates.
Eigen::MatrixXd stayed(const Eigen::MatrixXd &rows, const WeldedCoordinates &welded);

/// @throws std::invalid_argument if interfaces are farther apart than the tolerance of their joint; without one a
/// thousandth of the longest distance between interfaces or points of the two parts.
WeldedCoordinates weld(const FrameOfParts &frame, const PartUnion &parts, const std::vector<ReducedFrame> &of);

} // namespace gestell::coupling
