#pragma once

#include "fem/assembly/affine_constraints.h"
#include "fem/assembly/cell_materials.h"
#include "fem/assembly/quadratic_mesh.h"
#include "fem/values/frame_matrices.h"

namespace gestell::fem
{

/// What the cells of a frame add up to.
struct AssembledMatrices
{
  SparseMatrix    C, M;              ///< [n x n] in the coordinates of the frame
  double          rigid_energy = 0.; ///< FrameFacts::rigid_energy
  Eigen::VectorXd nodal_mass;        ///< [n_nodes] kg
  MassProperties  whole;
};

AssembledMatrices sum_cells(const QuadraticMesh &mesh, const CellMaterials &materials, const AffineConstraints &affine);

} // namespace gestell::fem
