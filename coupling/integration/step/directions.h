#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace gestell::coupling
{

// Products with the directions W [n x n_u] of the measures, compressed; most measures are one coordinate each, so that
// the iterators of a general product would take longer than its multiplications.

/// xi = W^T x
/// @param x  [n], the first numbers of a vector
void take_measures(const Eigen::SparseMatrix<double> &W, const Eigen::VectorXd &x, Eigen::VectorXd &xi);

/// f += factor W p
/// @param f  [n], the first numbers of a vector
void add_forces(const Eigen::SparseMatrix<double> &W, double factor, const Eigen::VectorXd &p, Eigen::VectorXd &f);

} // namespace gestell::coupling
