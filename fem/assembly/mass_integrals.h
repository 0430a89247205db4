#pragma once

#include "fem/assembly/affine_constraints.h"
#include "fem/assembly/cell_materials.h"
#include "fem/assembly/quadratic_mesh.h"
#include "fem/values/frame_matrices.h"

#include <Eigen/Core>

#include <vector>

namespace gestell::fem
{

/// Nodal masses (row sums of M) and first moments.
struct NodalMasses
{
  Eigen::VectorXd  mass;   ///< [n_nodes] int rho N_a dV [kg]
  Eigen::Matrix3Xd moment; ///< [3 x n_nodes] int rho N_a (x - origin) dV [kg m]
};
NodalMasses nodal_masses(const QuadraticMesh &mesh, const CellMaterials &materials, const Eigen::Vector3d &origin);

/// Mass, centre and inertia of all cells: M carries linear fields exactly, so  S = sum_ab M_ab x_a x_b^T  is
/// int rho x x^T dV and  J = tr(S) I - S.
/// @param origin of the moments; best near the centre, where no digits cancel.
MassProperties mass_integrals(const QuadraticMesh &mesh, const NodalMasses &masses, const Eigen::Vector3d &origin);

/// Load of a unit acceleration field in x, y, z [n x 3].
Eigen::MatrixXd acceleration_load(const Eigen::VectorXd &nodal_mass, const AffineConstraints &affine);

/// Mass and material of every solid.
std::vector<FrameFacts::SolidMass> solid_masses(const Mesh &mesh, const QuadraticMesh &quadratic,
                                                const CellMaterials &materials);

Eigen::Vector3d middle_of_nodes(const QuadraticMesh &mesh);

} // namespace gestell::fem
