#pragma once

#include "fem/values/cell_shape.h"

#include <Eigen/Core>

#include <vector>

namespace gestell::fem
{

/// A kind of quadratic cell as in deal.II: FE_SimplexP(2), FE_Q(2) or FE_WedgeP(2), tabulated once.
struct ReferenceCell
{
  /// Shape functions N_a at points of the reference cell.
  struct Points
  {
    Eigen::Matrix3Xd xi;
    Eigen::VectorXd  weight; ///< of the quadrature; empty for plain points
    Eigen::MatrixXd  N;      ///< [n_nodes x points]
    Eigen::MatrixXd  dN;     ///< [n_nodes x 3 points] dN_a / dxi_d of point k in column 3 k + d

    int size() const { return static_cast<int>(N.cols()); }
  };
  int                           n_nodes = 0, n_corners = 0; ///< corners are the first nodes
  std::vector<int>              node_of_corner;             ///< index of corner k of Mesh among the nodes
  std::vector<std::vector<int>> between;                    ///< for each node the corners between which it is
  std::vector<std::vector<int>> faces;                      ///< corners, of a quadrilateral in the order of FE_Q
  Points                        nodes;
  Points                        rule;  ///< exact for masses and stiffnesses of cells with parallel edges
  Points                        finer; ///< exact for stiffnesses of cubic and quadratic functions
  Points samples;                      ///< superconvergent stress points: Gauss points one order below full integration
  /// [samples x corners] Values at the corners of the polynomial (linear, trilinear) through values at the samples.
  Eigen::MatrixXd to_corners;
};
const ReferenceCell &reference_cell(CellKind kind);

} // namespace gestell::fem
