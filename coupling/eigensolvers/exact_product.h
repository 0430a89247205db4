#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace gestell::coupling
{

/**
 * A X for a symmetric sparse A (both triangles stored), with every entry summed in twice the working precision.
 *
 * For the product of the stiffness with nearly rigid motions, whose large terms cancel: otherwise the rounding in X^T A
 * X would make the lowest frequencies depend on the solver of X.
 *
 * Source: Dot2 of Ogita, Rump & Oishi, SIAM J. Sci. Comput. 26(6), 2005, 1955-1988.
 */
Eigen::MatrixXd exact_product(const Eigen::SparseMatrix<double> &A, const Eigen::Ref<const Eigen::MatrixXd> &X);

} // namespace gestell::coupling
