#pragma once

namespace gestell::fem
{

/**
 * Starts MPI, PETSc and SLEPc once per process, without a command line and without mpirun; ends them at exit.
 *
 * Call it at the beginning of every function that creates a PETSc or SLEPc object; later calls have no effect. A
 * running MPI or PETSc is left to its owner; each rank starts its own PETSc.
 *
 * @throws std::runtime_error if SLEPc does not start.
 */
void petsc_session();

} // namespace gestell::fem
