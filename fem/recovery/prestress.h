#pragma once

#include "fem/assembly/affine_constraints.h"
#include "fem/assembly/cell_materials.h"
#include "fem/assembly/interfaces.h"
#include "fem/values/frame_specification.h"

#include <Eigen/Core>

#include <vector>

namespace gestell::fem
{

/// Static loads of Prestress.
struct PrestressLoads
{
  /// A force at a rigid distance from a node.
  struct Offset
  {
    const Interface *node = nullptr;
    Eigen::Vector3d  force, arm; ///< [N], [m]
  };

  Eigen::VectorXd     on_nodes; ///< [3 n_nodes] weight of cells, and loads on surfaces [N]
  std::vector<Offset> weights;  ///< of attached masses

  Eigen::VectorXd on_masses(int n) const; ///< their weights in the coordinates of the frame [n]
};

/// @param nodes  of masses and interfaces.
/// @throws std::invalid_argument for unknown surfaces.
PrestressLoads prestress_loads(const Prestress &prestress, const std::vector<AttachedMass> &masses, const Mesh &mesh,
                               const QuadraticMesh &quadratic, const CellMaterials &materials,
                               const std::vector<Interface> &nodes);

/**
 * Geometric stiffness of the frame [n x n] under the stresses of CellMaterials::u0: the sum of geometric_stiffness() of
 * cells, and for rotations theta of a rigid face, whose points also move by  1/2 theta x (theta x r),  with the forces
 * c_i that hold them (of cells less loads), and for a weight f at an arm r with c = -f. Of an averaged face the node
 * moves by the same, in the opposite direction:
 *
 *     theta^T K theta = sum c_i . theta x (theta x r_i),     K = sum (c_i r_i^T + r_i c_i^T) / 2 - (c_i . r_i) I.
 *
 * With both parts a rigid rotation of a frame whose loads are f_k at x_k has the energy  -1/2 sum f_k . theta x (theta
 * x x_k), none if its stresses are in equilibrium without loads.
 *
 * @param coupled  patches of `nodes`.
 */
SparseMatrix geometric_stiffness(const QuadraticMesh &mesh, const CellMaterials &materials,
                                 const AffineConstraints &affine, const std::vector<CoupledPatch> &coupled,
                                 const std::vector<Interface> &nodes, const PrestressLoads &loads);

} // namespace gestell::fem
