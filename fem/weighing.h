#pragma once

#include "fem/block_matrix.h"
#include "fem/cell_materials.h"
#include "fem/frame_matrices.h"
#include "fem/kinematics.h"
#include "fem/quadratic_mesh.h"

#include <Eigen/Core>

#include <vector>

namespace gestell::fem
{

/// Mass of every node, int rho N_a dV [kg]: the row sums of M.
Eigen::VectorXd nodal_mass(const BlockMatrix &M);

/// Mass, centre and inertia of all cells: M carries linear fields exactly, so  S = sum_ab M_ab x_a x_b^T  is
/// int rho x x^T dV and  J = tr(S) I - S.
MassProperties weigh(const QuadraticMesh &mesh, const BlockMatrix &M);

/// Load of a unit acceleration field in x, y, z [n x 3].
Eigen::MatrixXd acceleration_load(const Eigen::VectorXd &nodal_mass, const Kinematics &kinematics);

/// Mass and material of every solid.
std::vector<FrameFacts::Part> solid_masses(const Mesh &mesh, const QuadraticMesh &quadratic,
                                           const CellMaterials &materials);

/// Largest  u^T C u / |u|^T |C| |u|  over the six rigid motions about the middle of the nodes: rounding, unless an
/// element is wrong.
/// @param C of the free frame, without foundations.
double rigid_energy(const QuadraticMesh &mesh, const BlockMatrix &C);

} // namespace gestell::fem
