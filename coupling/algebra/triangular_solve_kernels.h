#pragma once

#include "coupling/algebra/kernel_types.h"

namespace gestell::coupling
{

/// The fastest kernels for this processor.
const TriangularSolveKernels &triangular_solve_kernels();

/// Algebra for blocks of `columns` columns, processed in groups of block_algebra().columns.
const BlockAlgebra &block_algebra(int columns);
/// Sweeps for the panels of such a block.
const TriangularSolve &block_triangular_solve(int columns);

} // namespace gestell::coupling
