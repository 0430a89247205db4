#pragma once

namespace gestell::fem
{

/**
 * Starts MPI, PETSc and SLEPc once per process, without a command line and without mpirun; ends them at exit.
 *
 * Call it at the head of every function that makes a PETSc or SLEPc object; later calls cost nothing.  Where MPI or
 * PETSc already run they are left to whoever started them, and each rank starts PETSc for itself.
 *
 * @throws std::runtime_error if SLEPc refuses to start.
 */
void petsc_session();

} // namespace gestell::fem
