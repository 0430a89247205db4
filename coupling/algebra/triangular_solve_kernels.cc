#include "coupling/algebra/triangular_solve_kernels.h"

#include "coupling/algebra/tile_kernels.h"
#include "coupling/algebra/triangular_solve_avx512.h"

#include <cstdlib>
#include <string>

namespace gestell::coupling
{

namespace
{

using Narrow = Block<Four, 1, 8>;
using Wide   = Block<Four, 2, 4>;

constexpr TriangularSolveKernels any_processor = {sweeps_of<Single>, sweeps_of<Narrow>, sweeps_of<Wide>,
                                                  sweeps_of<Block<Four, 3, 4>>};
constexpr AlgebraKernels         any_algebra   = {algebra_of<Narrow>, algebra_of<Wide>};

/// Whether kernels for AVX-512 are compiled, not disabled and supported by the processor.
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

const TriangularSolveKernels &triangular_solve_kernels()
{
  return has_avx512() ? avx512_triangular_solve_kernels() : any_processor;
}

namespace
{

/// Whether the kernel for many columns is to be used.
bool wants_many(int columns)
{
  return columns > triangular_solve_kernels()[1].columns;
}

} // namespace

const BlockAlgebra &block_algebra(int columns)
{
  return (has_avx512() ? avx512_block_algebra() : any_algebra)[wants_many(columns) ? 1 : 0];
}

const TriangularSolve &block_triangular_solve(int columns)
{
  return triangular_solve_kernels()[wants_many(columns) ? 2 : 1];
}

#if !defined(GESTELL_AVX512_KERNELS)
const TriangularSolveKernels &avx512_triangular_solve_kernels()
{
  return any_processor;
}
const AlgebraKernels &avx512_block_algebra()
{
  return any_algebra;
}
#endif

} // namespace gestell::coupling
