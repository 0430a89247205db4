#pragma once

#include "fem/values/cell_shape.h"

#include <Eigen/Core>

#include <vector>

namespace gestell::fem
{

/// A kind of quadratic cell as in deal.II: FE_SimplexP(2), FE_Q(2) or FE_WedgeP(2).
struct ReferenceCell
{
  int                           n_nodes = 0, n_corners = 0; ///< corners are the first nodes
  std::vector<int>              node_of_corner;             ///< index of corner k of Mesh among the nodes
  std::vector<std::vector<int>> between;                    ///< for each node the corners between which it is
  std::vector<std::vector<int>> faces;                      ///< corners, of a quadrilateral in the order of FE_Q
  Eigen::Matrix3Xd              nodes, samples;             ///< reference coordinates, see CellPoints
  /// [samples x corners] Values at the corners of the polynomial (linear, trilinear) through values at the samples.
  Eigen::MatrixXd to_corners;
};
const ReferenceCell &reference_cell(CellKind kind);

} // namespace gestell::fem
