#pragma once

#include "fem/values/mesh.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace gestell::fem
{

/**
 * The triquadratic hexahedron of 27 nodes on [-1, 1]^3, N = product of 1D quadratics.
 *
 * Node i + 3 j + 9 k, i, j, k = 0, 1, 2, stands at (i - 1, j - 1, k - 1).  Its geometry is interpolated as its
 * displacements are, so that nodes moved onto a curved surface bend its sides.
 */
namespace hexahedron
{

constexpr int n_nodes = 27, n_face_nodes = 9;

using Nodes     = std::array<int, n_nodes>;
using Values    = Eigen::Matrix<double, n_nodes, 1>;
using Gradients = Eigen::Matrix<double, n_nodes, 3>; // dN_a / dxi_d
using Positions = Eigen::Matrix<double, 3, n_nodes>;

/// Where the corners stand among the nodes, in the order of gmsh (and VTK).
constexpr std::array<int, 8> corners = {0, 2, 8, 6, 18, 20, 26, 24};

/// Faces by their corners as numbered in Mesh::hexahedra, seen from outside counterclockwise.
constexpr std::array<std::array<int, 4>, 6> faces = {
    {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};

Values    values(const Eigen::Vector3d &xi);
Gradients gradients(const Eigen::Vector3d &xi);

/// Point of Gauss's rule with n points a direction, and its weight.
struct QuadraturePoint
{
  Eigen::Vector3d xi;
  double          weight;
  Values          N;
  Gradients       dN;
};

/// n = 2, whose points are where stresses are best, or n = 3, which integrates all matrices of a brick exactly; 4 does
/// so with cubics beside the quadratics.
const std::vector<QuadraturePoint> &quadrature(int n);

/// Where the nodes stand in the reference cell.
Eigen::Vector3d node_position(int node);

/// dx/dxi of nodes at X.
inline Eigen::Matrix3d jacobian(const Positions &X, const Gradients &dN)
{
  return X * dN;
}

/// int N_a N_b dA over a quadrilateral of 9 nodes (i + 3 j) at X, by 3 x 3 points.
Eigen::Matrix<double, 9, 9> face_mass(const Eigen::Matrix<double, 3, 9> &X);

} // namespace hexahedron

} // namespace gestell::fem
