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

/**
 * Geometric stiffness of functions N_a under the stress sigma of a displacement u in isotropic elastic material,
 *
 *     K_(a i)(b j) = delta_ij int grad N_a . sigma grad N_b dV,     sigma = lambda tr(e) I + 2 mu e,   e = sym grad u,
 *
 * [3 n x 3 n, N/m]; symmetric to the last bit, and zero for translations.
 *
 * @param u  [3 x k] nodal values of the first k <= n functions.
 *
 * Source: Bathe, Finite Element Procedures, 2014, section 6.2.3.
 */
Eigen::MatrixXd geometric_stiffness(const PointValues &cell, const Material &material,
                                    const Eigen::Ref<const Eigen::Matrix3Xd> &u);

/// Stiffness of a cell about its prestressed state: with CellMaterials::u0 both are added.
Eigen::MatrixXd tangent_stiffness(const PointValues &at, const QuadraticMesh &mesh, const CellMaterials &materials,
                                  int cell);

/// Consistent mass rho int N_a N_b dV [kg] of every direction [n x n].
Eigen::MatrixXd mass_matrix(const PointValues &cell, double rho);

/// Sums of both over these cells in the coordinates of the frame.
MatrixSums assemble(const QuadraticMesh &mesh, const CellMaterials &materials, const AffineConstraints &affine,
                    const Extent &extent);
Extent     whole(const QuadraticMesh &mesh, const AffineConstraints &affine);

/// Sum of geometric_stiffness() under CellMaterials::u0.
SparseMatrix assemble_geometric(const QuadraticMesh &mesh, const CellMaterials &materials,
                                const AffineConstraints &affine, const Extent &extent);

} // namespace gestell::fem
