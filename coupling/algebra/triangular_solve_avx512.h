#pragma once

#include "coupling/algebra/triangular_solve_kernels.h"

namespace gestell::coupling
{

/// Those of tile_sweeps.h for processors with AVX-512 alone.
const SweepKernels   &avx512_tile_sweeps();
const AlgebraKernels &avx512_block_algebra();

} // namespace gestell::coupling
