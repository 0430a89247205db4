#include "coupling/tile_sweeps.h"

#include "coupling/tile_kernels.h"
#include "coupling/tile_sweeps_avx512.h"

#include <cstdlib>
#include <string>

namespace gestell::coupling
{

namespace
{

using Wide = Block<Four, 2, 4>;

constexpr SweepKernels any_processor = {sweeps_of<Single>, sweeps_of<Block<Four, 1, 8>>, sweeps_of<Wide>,
                                        sweeps_of<Block<Four, 3, 4>>};
constexpr BlockAlgebra any_algebra   = algebra_of<Wide>;

/// Whether the kernels for AVX-512 are there, wanted, and within what the processor can do.
bool has_avx512()
{
#if defined(GESTELL_AVX512_KERNELS)
  static const char *const wish = std::getenv("GESTELL_KERNELS");
  static const bool        has  = !(wish && wish == std::string("portable")) && __builtin_cpu_supports("avx512f") &&
                          __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") &&
                          __builtin_cpu_supports("avx512bw");
  return has;
#else
  return false;
#endif
}

} // namespace

const SweepKernels &tile_sweeps()
{
  return has_avx512() ? avx512_tile_sweeps() : any_processor;
}

const BlockAlgebra &block_algebra()
{
  return has_avx512() ? avx512_block_algebra() : any_algebra;
}

const TileSweeps &block_sweeps()
{
  return tile_sweeps()[2];
}

#if !defined(GESTELL_AVX512_KERNELS)
const SweepKernels &avx512_tile_sweeps()
{
  return any_processor;
}
const BlockAlgebra &avx512_block_algebra()
{
  return any_algebra;
}
#endif

} // namespace gestell::coupling
