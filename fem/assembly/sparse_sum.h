#pragma once

#include "fem/values/sparse_matrix.h"

namespace gestell::fem
{

/// A += S; if A has an entry wherever S has one, A keeps its memory.  Both have the same size.
void add(SparseMatrix &A, const Eigen::SparseMatrix<double> &S);

} // namespace gestell::fem
