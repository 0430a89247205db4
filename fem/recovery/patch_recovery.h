#pragma once

#include "fem/assembly/cell_values.h"
#include "fem/values/frame_specification.h"

#include <Eigen/Core>

#include <vector>

namespace gestell::fem
{

/// Stresses xx yy zz xy yz zx [Pa] of several fields: six rows per field, one column per point.
using Stresses = Eigen::MatrixXd;

/// Displacements [m] of several fields: three rows per field, one column per node of the mesh.
using NodalFields = Eigen::MatrixXd;

/// Stresses at points of one cell, from this cell alone [6 f x points].
void stresses_at(const PointValues &points, const QuadraticMesh &mesh, const Material &material, int cell,
                 const NodalFields &u, Eigen::Ref<Stresses> result);

/**
 * Continuous stresses sigma* of the cells of one material at their nodes [6 f x n_nodes], 0 at others: superconvergent
 * patch recovery.
 *
 * Around every corner of a cell a quadratic polynomial is fitted by least squares to the stresses at the Gauss points
 * of the cells there (and of their neighbours, if there are few).  A corner has the value of its own fit, any other
 * node the mean of the fits of its corners.
 *
 * Source: Zienkiewicz & Zhu, Int. J. Num. Meth. Eng. 33, 1992, 1331-1364.
 */
Stresses recovered_stresses(const QuadraticMesh &mesh, const Material &material, const std::vector<int> &cells,
                            const NodalFields &u);

/// s : C^-1 : t  [J/m^3] of an isotropic material.
double energy_product(const Eigen::Ref<const Eigen::Matrix<double, 6, 1>> &s,
                      const Eigen::Ref<const Eigen::Matrix<double, 6, 1>> &t, const Material &material);

} // namespace gestell::fem
