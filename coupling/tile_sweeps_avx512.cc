// Compiled for processors with AVX-512; called only where there is one.
#include "coupling/tile_sweeps_avx512.h"

#include "coupling/tile_kernels.h"

namespace gestell::coupling
{

namespace
{

using Wide = Block<Eight, 2, 8>;

constexpr TileSweeps   sweeps[3] = {sweeps_of<Single>, sweeps_of<Block<Eight, 1, 8>>, sweeps_of<Wide>};
constexpr BlockAlgebra algebra   = algebra_of<Wide>;

} // namespace

const TileSweeps (&avx512_tile_sweeps())[3]
{
  return sweeps;
}

const BlockAlgebra &avx512_block_algebra()
{
  return algebra;
}

} // namespace gestell::coupling
