#pragma once

#include "fem/assembly/affine_constraints.h"
#include "fem/assembly/cell_materials.h"
#include "fem/assembly/quadratic_mesh.h"

#include <Eigen/Core>

#include <set>
#include <vector>

namespace gestell::fem
{

/// A point of a tied face, and where it is in the cell that leads there.
struct TiedPoint
{
  double                       area = 0.; ///< weight of a quadrature [m^2]
  std::vector<int>             nodes;     ///< of the face
  Eigen::VectorXd              N;         ///< their functions
  int                          cell = 0;
  Eigen::Matrix<double, 27, 1> leading;           ///< functions of the nodes of the cell
  Eigen::Matrix<double, 27, 3> leading_gradients; ///< [1/m]
  double                       gap = 0.;          ///< by which the point is beyond the cell [m]
  Eigen::Vector3d              normal;            ///< out of the face
};

/// Quadrature points of the faces of a tie.
std::vector<TiedPoint> tied_points(const QuadraticMesh &mesh, const QuadraticTie &tie);

/**
 * Ties the nodes of faces to the cells at them: the displacement of the faces is the projection of that of the cells,
 *
 *     int phi_i (u - u_cell) dA = 0    for all functions phi_i of the faces' free nodes.
 *
 * Fields that are linear over all are kept exactly, whatever points the integrals use: rigid motions cost no energy.
 * The cells' functions are evaluated beyond them where faces are polygons of the same curve.
 *
 * @param excluded  nodes whose displacements others depend on, of interfaces and masses
 */
void tie_meshes(const QuadraticMesh &mesh, const std::set<int> &excluded, MultipointConstraints &constraints);

/**
 * Work of the stresses of the leading cells at the gap between both sides of a tie,  |int (sigma n) (u - u_cell) dA|
 * [J]: by which an energy is wrong.
 *
 * @param u  displacements [3 n_nodes]
 */
double tie_work(const QuadraticMesh &mesh, const std::vector<TiedPoint> &points, const CellMaterials &materials,
                const Eigen::VectorXd &u);

} // namespace gestell::fem
