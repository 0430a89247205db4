#pragma once

#include "fem/assembly/affine_constraints.h"
#include "fem/assembly/cell_materials.h"
#include "fem/assembly/cell_parts.h"
#include "fem/assembly/quadratic_mesh.h"
#include "fem/assembly/raised_degree.h"

#include <Eigen/Core>

#include <vector>

namespace gestell::fem
{

/**
 * Discretisation error of displacement fields, estimated by stress recovery.
 *
 * Stresses of finite elements are discontinuous between cells.  Around every corner of the mesh a quadratic polynomial
 * is fitted to the stresses of the cells there (superconvergent patch recovery); the fits, put together as a continuous
 * field sigma*, are more accurate than the stresses sigma_h, so that the energy of their difference,
 *
 *     eta_K^2 = int_K (sigma* - sigma_h) : C^-1 : (sigma* - sigma_h) dV     [J, twice the strain energy],
 *
 * estimates the error of the field.  For a mode with phi^T M phi = 1 and for the deflection under static loads f
 * (docs/theory/mesh_error.md):
 *
 *     omega_h^2 - omega^2  ~  sum_K eta_K^2,        f^T u - f^T u_h  ~  sum_K eta_K^2.
 *
 * Source: Zienkiewicz & Zhu, Int. J. Num. Meth. Eng. 33, 1992, 1331-1364.
 */
class MeshError
{
public:
  MeshError(QuadraticMesh mesh, CellMaterials materials, AffineConstraints affine);

  /**
   * @param q  fields in the coordinates of the frame [n x k].
   * @return   eta_K^2 of every cell and field [n_cells x k].
   */
  Eigen::MatrixXd of_cells(const Eigen::Ref<const Eigen::MatrixXd> &q) const;

  /// For every field the work at the ties between meshes, by which twice its strain energy is wrong [k], see
  /// tie_work(); empty without ties.
  Eigen::VectorXd of_ties(const Eigen::Ref<const Eigen::MatrixXd> &q) const;

  /// The frame in elements of degree three on the same mesh.
  RaisedFrame raised(const FrameMatrices &frame) const
  {
    return raise_degree(mesh_, materials_, affine_, frame.C, frame.M);
  }

  /// The cells of the frame in parts; refers to this object.
  CellParts parts(int number, const std::string &place) const { return {mesh_, materials_, affine_, number, place}; }

  const QuadraticMesh &mesh() const { return mesh_; }

private:
  QuadraticMesh     mesh_;
  CellMaterials     materials_;
  AffineConstraints affine_;
};

/// Relative frequency error of the mesh: omega_h / sqrt(omega_h^2 - eta^2) - 1, for
/// share = eta^2 / omega_h^2; infinite if the estimate reaches the whole energy.
double relative_frequency_error(double share);

} // namespace gestell::fem
