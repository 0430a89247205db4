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

/// Energies u^T C u of the six rigid motions, and |u|^T |C| |u|, whose terms cancel in them; sums over parts of a mesh.
struct RigidEnergies
{
  Eigen::Matrix<double, 6, 1> energy     = Eigen::Matrix<double, 6, 1>::Zero();
  Eigen::Matrix<double, 6, 1> cancelling = Eigen::Matrix<double, 6, 1>::Zero();

  /// Largest quotient: rounding, unless an element is wrong.
  double share() const { return (energy.array().abs() / cancelling.array()).maxCoeff(); }
};

Eigen::Vector3d middle_of_nodes(const QuadraticMesh &mesh);

/// Of the rigid motions about `middle`.
/// @param C of the free frame, without foundations.
RigidEnergies rigid_energies(const QuadraticMesh &mesh, const BlockMatrix &C, const Eigen::Vector3d &middle);

/// Their largest quotient, about the middle of the nodes.
double rigid_energy(const QuadraticMesh &mesh, const BlockMatrix &C);

} // namespace gestell::fem
