#pragma once

#include "coupling/eigensolvers/block_lanczos.h"

#include <Eigen/SparseCore>

#include <mpi.h>

#include <memory>
#include <string>

namespace gestell::coupling
{

/// (C - omega^2 M) v = 0 with C^-1 available; see ModeProblem, also for lifetimes.
struct ModePencil
{
  std::shared_ptr<const InverseStiffness> inverse;
  const Eigen::SparseMatrix<double>      *M = nullptr;
  const Eigen::SparseMatrix<double>      *C = nullptr; ///< null: for methods that use only M and C^-1
};

/**
 * The search for the lowest modes by an EPS of SLEPc: generalised Hermitian, shift-and-invert at 0 by the given
 * inverse.
 *
 * `eigensolver` is "block-lanczos" (our own type), "krylov-schur" or any type of SLEPc; hyphens in the names of SLEPc's
 * types do not count.  Preconditioned ones (lobpcg, gd, jd, rqcg) use the inverse as preconditioner.  Options of PETSc
 * and SLEPc with the prefix reduction_eps_ (PETSC_OPTIONS="-reduction_eps_view") have priority, except for the number
 * of modes and the target.
 *
 * @param known  modes found elsewhere, M-orthonormal: only further ones are computed.
 * @throws ConvergenceFailure, also with the messages of PETSc and SLEPc.
 */
std::unique_ptr<ModeSearch> search_modes(MPI_Comm comm, const ModePencil &pencil, const std::string &eigensolver,
                                         const BlockLanczos::Options &options, const LowestModes &known);

} // namespace gestell::coupling
