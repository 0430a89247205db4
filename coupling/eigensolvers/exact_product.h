#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace gestell::coupling
{

/**
 * A^T X + Y for a sparse A, such as a symmetric one with both triangles stored, with every entry summed in twice the
 * working precision.
 *
 * For the product of the stiffness with nearly rigid motions, whose large terms cancel: otherwise the rounding in X^T A
 * X would make the lowest frequencies depend on the solver of X.
 *
 * Source: Dot2 of Ogita, Rump & Oishi, SIAM J. Sci. Comput. 26(6), 2005, 1955-1988.
 */
void exact_product(const Eigen::Ref<const Eigen::SparseMatrix<double>> &A, const Eigen::Ref<const Eigen::MatrixXd> &X,
                   Eigen::Ref<Eigen::MatrixXd> Y);
Eigen::MatrixXd exact_product(const Eigen::SparseMatrix<double> &A, const Eigen::Ref<const Eigen::MatrixXd> &X);

} // namespace gestell::coupling
