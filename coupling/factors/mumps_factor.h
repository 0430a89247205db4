#pragma once

#include "coupling/eigensolvers/slepc/petsc_objects.h"
#include "fem/parallel/ranks.h"

namespace gestell::coupling
{

/// PETSc's options of a matrix and its factor begin with it: -reduction_mat_mumps_icntl_22 1.
constexpr const char *matrix_prefix = "reduction_";

/// Throws std::runtime_error with PETSc's message; during the lifetime of a QuietPetsc.
void require(PetscErrorCode code);

/**
 * L L^T of a positive definite matrix, or L D L^T with pivots, by MUMPS on all ranks.  Collective.
 *
 * @param A          its rows are in the order of elimination, that of nested dissection.
 * @param available  bytes of this computer.
 * @returns null if L L^T does not exist.
 * @throws NotEnoughMemory by the estimate in one process, fem::AgreedFailure with the name of the computer on several
 *         ranks; ConvergenceFailure where MUMPS itself fails.
 */
PetscOwned<Mat> mumps_factor(const fem::Ranks &ranks, Mat A, bool definite, double available);

} // namespace gestell::coupling
