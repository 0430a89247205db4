#pragma once

#include "fem/assembly/block_matrix.h"
#include "fem/assembly/cell_materials.h"
#include "fem/assembly/quadratic_mesh.h"
#include "fem/values/frame_specification.h"

#include <Eigen/Core>

namespace gestell::fem
{

/// [3 n x 3 n] and [n x n], n nodes of a cell.
using CellStiffness = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, 81, 81>;
using CellMass      = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, 27, 27>;

/**
 * Stiffness of one cell of isotropic elastic material,
 *
 *     C_(a i)(b j) = int lambda N_a,i N_b,j + mu (N_a,j N_b,i + delta_ij grad N_a . grad N_b) dV     [N/m]
 *
 * with Lame's lambda = E nu / ((1 + nu)(1 - 2 nu)), mu = E / (2 (1 + nu)); exact for straight tetrahedra, whose
 * Jacobian is constant, and for hexahedra and prisms with parallel edges; else by ReferenceCell::rule.
 */
CellStiffness cell_stiffness(const QuadraticMesh &mesh, int cell, const Material &material);

/// Consistent mass rho int N_a N_b dV [kg], the same for all three directions.
CellMass cell_mass(const QuadraticMesh &mesh, int cell, const Material &material);

/// C of the free frame, blocks of 3 x 3 between nodes.
BlockMatrix assemble_stiffness(const QuadraticMesh &mesh, const CellMaterials &materials);

/// M of the free frame for one direction: M_full = M (x) I_3.
BlockMatrix assemble_mass(const QuadraticMesh &mesh, const CellMaterials &materials);

} // namespace gestell::fem
