#pragma once

namespace gestell::coupling
{

/// Sets OpenBLAS to one thread (its waiting threads spin) unless the environment OPENBLAS_NUM_THREADS asks for more.
/// @throws std::invalid_argument if the BLAS in this process is another library: others are slower by an order.
void use_one_blas_thread();

} // namespace gestell::coupling
