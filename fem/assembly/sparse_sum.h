#pragma once

#include "fem/values/sparse_matrix.h"

namespace gestell::fem
{

/// A += S; where A has an entry wherever S has one, A stays where it lies.  Both of one size.
void add(SparseMatrix &A, const Eigen::SparseMatrix<double> &S);

} // namespace gestell::fem
