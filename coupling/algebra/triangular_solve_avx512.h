#pragma once

#include "coupling/algebra/kernel_types.h"

namespace gestell::coupling
{

/// Those of tile_kernels.h for processors with AVX-512 alone.
const TriangularSolveKernels &avx512_triangular_solve_kernels();
const AlgebraKernels         &avx512_block_algebra();

} // namespace gestell::coupling
