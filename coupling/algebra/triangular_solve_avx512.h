#pragma once

#include "coupling/algebra/kernel_types.h"

namespace gestell::coupling
{

/// The kernels of tile_kernels.h only for processors with AVX-512.
const TriangularSolveKernels &avx512_triangular_solve_kernels();
const AlgebraKernels         &avx512_block_algebra();

} // namespace gestell::coupling
