#pragma once

#include "fem/assembly/cell_materials.h"
#include "fem/assembly/interfaces.h"
#include "fem/values/frame_specification.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

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
 * Geometric stiffness [n x n] of rotations theta of a rigid face, whose points also move by  1/2 theta x (theta x r),
 * with the forces c_i that hold them (of cells under CellMaterials::u0, less loads), and of a weight f at an arm r with
 * c = -f. Of an averaged face the node moves by the same, in the opposite direction:
 *
 *     theta^T K theta = sum c_i . theta x (theta x r_i),     K = sum (c_i r_i^T + r_i c_i^T) / 2 - (c_i . r_i) I.
 *
 * With that of the cells, assemble_geometric(), a rigid rotation of a frame whose loads are f_k at x_k has the energy
 * -1/2 sum f_k . theta x (theta x x_k), none if its stresses are in equilibrium without loads.
 *
 * @param n        DOFs of the frame.
 * @param coupled  patches of `nodes`.
 */
Eigen::SparseMatrix<double> stiffness_of_turns(const QuadraticMesh &mesh, const CellMaterials &materials, int n,
                                               const std::vector<CoupledPatch> &coupled,
                                               const std::vector<Interface> &nodes, const PrestressLoads &loads);

} // namespace gestell::fem
