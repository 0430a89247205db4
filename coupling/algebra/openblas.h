#pragma once

namespace gestell::coupling
{

/**
 * Selects the best OpenBLAS kernels. A library older than the processor uses the kernels of the oldest one
 * ("Prescott"), four times slower than those for AVX-512, 2.5 times slower than those for AVX2. Then the better ones
 * are selected, unless the environment variable OPENBLAS_CORETYPE names others. Acts at the first call; no BLAS routine
 * may run meanwhile.
 */
void use_fitting_blas_kernels();

/// The same, and sets OpenBLAS to one thread (its waiting threads spin) unless the environment variable
/// OPENBLAS_NUM_THREADS requests more.
/// @throws std::invalid_argument if the BLAS in this process is another library: others are slower by an order.
void use_one_blas_thread();

/// The same with a given number of threads.
void use_blas_threads(int n);

/// Number that the environment variable OPENBLAS_NUM_THREADS requests, which --jobs sets; 1 without it.
int jobs_requested();

} // namespace gestell::coupling
