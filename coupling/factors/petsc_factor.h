#pragma once

#include "coupling/factors/stiffness_factor.h"
#include "fem/parallel/ranks.h"

namespace gestell::coupling
{

/**
 * "mumps", or the solver of PETSC_OPTIONS, with rows of PETSc on all ranks.  Only rank 0 calls its functions; the
 * others carry them out in serve_petsc_factors().
 *
 * Matrices of all ranks are distributed by rank 0, as are right-hand sides; of the modes each rank has its own rows
 * until they are found.
 */
std::unique_ptr<StiffnessFactor> petsc_stiffness_factor(const fem::Ranks &ranks, FactorMatrices matrices);

/// The ranks that take part in the factors of this run: all, if rank 0 has called share_factors(); otherwise one.
const fem::Ranks &ranks_of_factors();
void              share_factors();

/// On ranks above 0: what rank 0 has called, by the number of its order.
void serve_petsc_factors(int order);

} // namespace gestell::coupling
