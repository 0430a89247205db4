#pragma once

#include "coupling/eigensolvers/slepc/mode_problem.h"
#include "coupling/eigensolvers/slepc/petsc_objects.h"

namespace gestell::coupling
{

/// Names with PETSc and SLEPc.
constexpr const char *own_factor        = "gestell";
constexpr const char *own_block_lanczos = "block-lanczos";

/**
 * Makes two types of our own known to PETSc and SLEPc; later calls cost nothing.
 *
 * MatSolverType "gestell": SparseCholesky, for MATSEQAIJ and MATSEQSBAIJ, with inertia; for the operators below the
 * inverse that their problem has.
 *
 * EPSType "block-lanczos": BlockLanczos, for GHEP with shift-and-invert at the target 0, by whatever solves in the
 * spectral transformation.  Solved again with a larger number of modes it goes on from the space it has.
 */
void register_own_types();

/// C22 and M22 as shells that copy nothing; the problem must outlive them.
PetscOwned<Mat> stiffness_operator(MPI_Comm comm, const ModeProblem &problem);
PetscOwned<Mat> mass_operator(MPI_Comm comm, const ModeProblem &problem);

// Of an EPS of the type "block-lanczos":

/// @param known  modes [coordinates x k] that are part of the space from the start.
void set_block_lanczos(EPS eps, const BlockLanczos::Options &options, const LowestModes &known);
/// After EPSSolve().
const BlockLanczos &block_lanczos_of(EPS eps);

} // namespace gestell::coupling
