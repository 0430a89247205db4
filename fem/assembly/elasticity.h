#pragma once

#include "fem/assembly/block_matrix.h"
#include "fem/assembly/cell_materials.h"
#include "fem/assembly/quadratic_mesh.h"
#include "fem/values/frame_specification.h"

#include <Eigen/Core>

#include <vector>

namespace gestell::fem
{

/// A point of a quadrature rule on the reference tetrahedron (n = 10 nodes, dim = 3) or triangle (6, 2).
template <int n, int dim>
struct ReferencePoint
{
  double                        weight = 0.;
  Eigen::Matrix<double, n, 1>   N      = Eigen::Matrix<double, n, 1>::Zero();
  Eigen::Matrix<double, n, dim> dN     = Eigen::Matrix<double, n, dim>::Zero(); ///< dN_a / dxi_d
};

/// Integrals over the reference tetrahedron (volume 1/6) and triangle (area 1/2) of quadratic shape functions N_a.
struct ReferenceIntegrals
{
  Eigen::Matrix<double, 10, 10> mass;                ///< int N_a N_b dV
  Eigen::Matrix3d               gradients[10][10];   ///< int (dN_a/dxi) (dN_b/dxi)^T dV
  Eigen::Matrix<double, 6, 6>   triangle_mass;       ///< int N_a N_b dA
  Eigen::Matrix<double, 10, 3>  corner_gradients[4]; ///< dN_a/dxi at the corners

  std::vector<ReferencePoint<10, 3>> tetrahedron; ///< exact to degree 5, for cells with curved sides
  std::vector<ReferencePoint<6, 2>>  triangle;
};

/// Made once by the finite elements and quadratures of deal.II, exact for these polynomials (degree 4).
const ReferenceIntegrals &reference_integrals();

/// [3 n x 3 n] and [n x n], n = 10 or 27 nodes of a cell.
using CellStiffness = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, 81, 81>;
using CellMass      = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, 27, 27>;

/**
 * Stiffness of one cell of isotropic elastic material,
 *
 *     C_(a i)(b j) = int lambda N_a,i N_b,j + mu (N_a,j N_b,i + delta_ij grad N_a . grad N_b) dV     [N/m]
 *
 * with Lame's lambda = E nu / ((1 + nu)(1 - 2 nu)), mu = E / (2 (1 + nu)); exact for straight tetrahedra, whose
 * Jacobian is constant, and for hexahedra with parallel edges; else by 14 points (tetrahedra with curved sides) or
 * 3 x 3 x 3 points of Gauss.
 */
CellStiffness cell_stiffness(const QuadraticMesh &mesh, int cell, const Material &material);

/// Consistent mass rho int N_a N_b dV [kg], the same for all three directions.
CellMass cell_mass(const QuadraticMesh &mesh, int cell, const Material &material);

/// C of the free frame, blocks of 3 x 3 between nodes.
BlockMatrix assemble_stiffness(const QuadraticMesh &mesh, const CellMaterials &materials);

/// M of the free frame for one direction: M_full = M (x) I_3.
BlockMatrix assemble_mass(const QuadraticMesh &mesh, const CellMaterials &materials);

} // namespace gestell::fem
