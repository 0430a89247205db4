#pragma once

#include "fem/assembly/quadratic_mesh.h"

#include <Eigen/Core>

#include <vector>

namespace gestell::fem
{

/// Shape functions of one kind of cell at the points stresses are looked at.
struct ReferenceCell
{
  struct Points
  {
    Eigen::MatrixXd N;  // [n_nodes x points]
    Eigen::MatrixXd dN; // [n_nodes x 3 points] dN_a / dxi_d of point k in column 3 k + d

    int  size() const { return static_cast<int>(N.cols()); }
    void add(const Eigen::VectorXd &values, const Eigen::Matrix<double, -1, 3> &slopes);
  };
  int                           n_nodes = 0;
  std::vector<int>              corners; ///< local nodes
  std::vector<std::vector<int>> between; ///< of each node the corners (as counted in `corners`) it stands amid
  Points                        samples; ///< where stresses are best: Gauss's points one order below full integration
  Points                        nodes;
};

/// Of the cells of a mesh: tetrahedra with 10 nodes or hexahedra with 27.
const ReferenceCell &reference_cell(const QuadraticMesh &mesh);

/// Nodes of a cell as columns [3 x n_nodes].
Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 27> positions(const QuadraticMesh &mesh, int cell);

} // namespace gestell::fem
