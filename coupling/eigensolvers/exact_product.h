#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace gestell::coupling
{

/**
 * A X for a symmetric sparse A (both triangles stored), every entry as if summed in twice the working precision.
 *
 * For stiffness times motions that hardly strain, whose large terms cancel: in X^T A X their rounding would be seen in
 * the lowest frequencies, as something that changes with the solver that made X.
 *
 * Source: Dot2 of Ogita, Rump & Oishi, SIAM J. Sci. Comput. 26(6), 2005, 1955-1988.
 */
Eigen::MatrixXd exact_product(const Eigen::SparseMatrix<double> &A, const Eigen::Ref<const Eigen::MatrixXd> &X);

} // namespace gestell::coupling
