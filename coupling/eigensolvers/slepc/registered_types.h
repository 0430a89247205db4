#pragma once

#include "coupling/eigensolvers/slepc/mode_problem.h"
#include "coupling/eigensolvers/slepc/petsc_objects.h"

namespace gestell::coupling
{

/// Names with PETSc and SLEPc.
constexpr const char *own_factor        = "gestell";
constexpr const char *own_block_lanczos = "block-lanczos";

/**
 * Registers two types of our own in PETSc and SLEPc; later calls have no effect.
 *
 * MatSolverType "gestell": SparseCholesky, for MATSEQAIJ and MATSEQSBAIJ, with inertia; for the operators below the
 * inverse of their problem.
 *
 * EPSType "block-lanczos": BlockLanczos, for GHEP with shift-and-invert at the target 0, with the solver of the
 * spectral transformation.  If it is solved again with a larger number of modes it continues with its space.
 */
void register_own_types();

/// C22 and M22 as shells that copy nothing; the problem must outlive them.
PetscOwned<Mat> stiffness_operator(MPI_Comm comm, const ModeProblem &problem);
PetscOwned<Mat> mass_operator(MPI_Comm comm, const ModeProblem &problem);

/// The data of a library behind a factor, for what its interface in PETSc has no function.
void *data_of_factor(Mat factor);

// For an EPS of the type "block-lanczos":

/// @param known  modes [coordinates x k] that are part of the space from the start.
void set_block_lanczos(EPS eps, const BlockLanczos::Options &options, const LowestModes &known);
/// After EPSSolve().
const BlockLanczos &block_lanczos_of(EPS eps);

} // namespace gestell::coupling
