#pragma once

namespace gestell::coupling
{

/**
 * Lets OpenBLAS use what the processor can.
 *
 * A library older than the processor takes it for the oldest there is ("Prescott") and computes four times slower than
 * with the kernels for AVX-512, 2.5 times slower than with those for AVX2.  Then these are chosen, unless the
 * environment variable OPENBLAS_CORETYPE names others.  Does its work at the first call; no BLAS routine may run
 * meanwhile.
 */
void use_fitting_blas_kernels();

/// The same, and sets OpenBLAS to one thread (its waiting threads spin) unless the environment OPENBLAS_NUM_THREADS
/// asks for more.
/// @throws std::invalid_argument if the BLAS in this process is another library: others are slower by an order.
void use_one_blas_thread();

} // namespace gestell::coupling
