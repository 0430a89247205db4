#pragma once

#include "fem/assembly/affine_constraints.h"
#include "fem/assembly/cell_materials.h"
#include "fem/assembly/cell_values.h"
#include "fem/values/frame_specification.h"

#include <Eigen/Core>

namespace gestell::fem
{

/**
 * Stiffness of functions N_a in isotropic elastic material [3 n x 3 n],
 *
 *     C_(a i)(b j) = int lambda N_a,i N_b,j + mu (N_a,j N_b,i + delta_ij grad N_a . grad N_b) dV     [N/m]
 *
 * with Lame's lambda = E nu / ((1 + nu)(1 - 2 nu)), mu = E / (2 (1 + nu)); symmetric to the last bit.
 */
Eigen::MatrixXd stiffness_matrix(const PointValues &cell, const Material &material);

/// Consistent mass rho int N_a N_b dV [kg] of every direction [n x n].
Eigen::MatrixXd mass_matrix(const PointValues &cell, double rho);

/// Sums of both over these cells in the coordinates of the frame.
MatrixSums assemble(const QuadraticMesh &mesh, const CellMaterials &materials, const AffineConstraints &affine,
                    const Extent &extent);
Extent     whole(const QuadraticMesh &mesh, const AffineConstraints &affine);

} // namespace gestell::fem
