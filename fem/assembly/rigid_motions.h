#pragma once

#include "fem/assembly/affine_constraints.h"
#include "fem/assembly/quadratic_mesh.h"
#include "fem/values/frame_matrices.h"
#include "fem/values/mesh.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace gestell::fem
{

/// Rigid motions of a point at x by (u0, theta) of a node at x0:  u = u0 + theta x (x - x0), as a matrix [3 x 6].
template <typename Centre>
Eigen::Matrix<double, 3, 6> rigid_motions_of_point(const Point3 &x, const Centre &x0)
{
  const double                r[3] = {x[0] - x0[0], x[1] - x0[1], x[2] - x0[2]};
  Eigen::Matrix<double, 3, 6> R;
  R << 1., 0., 0., 0., r[2], -r[1], //
      0., 1., 0., -r[2], 0., r[0],  //
      0., 0., 1., r[1], -r[0], 0.;
  return R;
}

/// Nodal displacements [3 n_nodes x 6] of the unit rigid motions about x0.
Eigen::MatrixXd rigid_displacements(const QuadraticMesh &mesh, const Eigen::Vector3d &x0);

/// The same in the coordinates of the frame [n x 6]; interfaces move with their positions.
Eigen::MatrixXd rigid_coordinates(const QuadraticMesh &mesh, const Eigen::Vector3d &x0, const AffineConstraints &affine,
                                  const std::vector<Interface> &interfaces);

/// Largest quotient  sum |q_i (C q)_i| / sum |q_i| (|C| |q|)_i  of the rigid motions q, C summed over the cells alone:
/// of rounding size unless an element, a coupling or a sum is wrong.  Both sums are over rows i to which no cell at a
/// support adds, since held displacements do not move rigidly; nan if there is none.
double rigid_energy_share(const SparseMatrix &C, const Eigen::MatrixXd &motions, const QuadraticMesh &mesh,
                          const AffineConstraints &affine);

/**
 * Rigid-body modes of the frame with some coordinates fixed, as text: "translation along x", "rotation about z",
 * "rotation about (0.6, 0, 0.8) through (1, 0, 2) m".  For unconnected parts each part separately: "translation along x
 * of part 2 of 2, near (1, 0, 2) m".
 *
 * @param frame  with rigid_motions; otherwise the result is empty.
 * @param held   fixed coordinates, e.g. frame.interface_coordinates().
 */
std::vector<std::string> free_motions(const FrameMatrices &frame, const std::vector<int> &held);

} // namespace gestell::fem
