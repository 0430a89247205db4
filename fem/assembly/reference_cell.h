#pragma once

#include "fem/values/cell_shape.h"

#include <Eigen/Core>

#include <vector>

namespace gestell::fem
{

/// A kind of quadratic cell as deal.II has it: FE_SimplexP(2), FE_Q(2) or FE_WedgeP(2), tabulated once.
struct ReferenceCell
{
  /// Shape functions N_a at points of the reference cell.
  struct Points
  {
    Eigen::Matrix3Xd xi;
    Eigen::VectorXd  weight; ///< of the quadrature; empty if it is none
    Eigen::MatrixXd  N;      ///< [n_nodes x points]
    Eigen::MatrixXd  dN;     ///< [n_nodes x 3 points] dN_a / dxi_d of point k in column 3 k + d

    int size() const { return static_cast<int>(N.cols()); }
  };
  int                           n_nodes = 0, n_corners = 0; ///< corners are the first nodes
  std::vector<int>              node_of_corner;             ///< where corner k of Mesh stands among the nodes
  std::vector<std::vector<int>> between;                    ///< of each node the corners it is between
  std::vector<std::vector<int>> faces;                      ///< corners, of a quadrilateral in the order of FE_Q
  Points                        nodes;
  Points                        rule;  ///< exact for masses and stiffnesses of cells with parallel edges
  Points                        finer; ///< exact for stiffnesses of cubics beside the quadratics
  Points samples;                      ///< superconvergent stress points: Gauss points one order below full integration
  /// [samples x corners] Values at the corners of the polynomial (linear, trilinear) through values at the samples.
  Eigen::MatrixXd to_corners;
};
const ReferenceCell &reference_cell(CellKind kind);

} // namespace gestell::fem
