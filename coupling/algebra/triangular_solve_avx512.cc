// Compiled for processors with AVX-512; called only where there is one.
#include "coupling/algebra/triangular_solve_avx512.h"

#include "coupling/algebra/tile_kernels.h"

namespace gestell::coupling
{

namespace
{

using Narrow = Block<Eight, 1, 8>;
using Wide   = Block<Eight, 2, 8>;

constexpr TriangularSolveKernels kernels = {sweeps_of<Single>, sweeps_of<Narrow>, sweeps_of<Wide>,
                                            sweeps_of<Block<Eight, 3, 8>>};
constexpr AlgebraKernels         algebra = {algebra_of<Narrow>, algebra_of<Wide>};

} // namespace

const TriangularSolveKernels &avx512_triangular_solve_kernels()
{
  return kernels;
}

const AlgebraKernels &avx512_block_algebra()
{
  return algebra;
}

} // namespace gestell::coupling
