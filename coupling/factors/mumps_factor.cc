#include "coupling/factors/mumps_factor.h"

#include "coupling/algebra/sparse_cholesky.h"
#include "coupling/integration/system/convergence_failure.h"

#include <unistd.h>

#include <algorithm>
#include <iterator>
#include <string>

namespace gestell::coupling
{

void require(PetscErrorCode code)
{
  if (code != 0)
    throw std::runtime_error("factor: PETSc failed with error " + std::to_string(code) + ": " + QuietPetsc::message());
}

namespace
{

std::string computer()
{
  char name[256] = "";
  gethostname(name, sizeof name - 1);
  return name;
}

/// Compares the need of the ranks on each computer with its memory.
void require_memory(const fem::Ranks &ranks, Mat F, double available)
{
  PetscInt on_disk = 0, megabytes = 0;
  MatMumpsGetIcntl(F, 22, &on_disk);
  MatMumpsGetInfo(F, on_disk ? 17 : 15, &megabytes);
  double needed = 1e6 * double(megabytes);
  if (ranks.size() == 1)
  {
    if (needed > available)
      throw NotEnoughMemory(needed, available);
    return;
  }
  MPI_Comm host = MPI_COMM_NULL;
  MPI_Comm_split_type(ranks.comm(), MPI_COMM_TYPE_SHARED, ranks.rank(), MPI_INFO_NULL, &host);
  MPI_Allreduce(MPI_IN_PLACE, &needed, 1, MPI_DOUBLE, MPI_SUM, host);
  MPI_Comm_free(&host);
  ranks.agree(
      [&]
      {
        if (needed > available)
          throw ConvergenceFailure("computer " + computer() + ": " + NotEnoughMemory(needed, available).what());
      });
}

} // namespace

PetscOwned<Mat> mumps_factor(const fem::Ranks &ranks, Mat A, bool definite, double available)
{
  require(MatSetOption(A, MAT_SPD, definite ? PETSC_TRUE : PETSC_FALSE));
  require(MatSetOptionsPrefixFactor(A, matrix_prefix));
  MatFactorInfo info;
  MatFactorInfoInitialize(&info);
  constexpr int first_spare = 30, largest_spare = 1000; // [%] of working memory beyond the estimate of the analysis
  for (int spare = first_spare;; spare *= 2)
  {
    Mat F = nullptr;
    require(MatGetFactor(A, MATSOLVERMUMPS, MAT_FACTOR_CHOLESKY, &F));
    PetscOwned<Mat> factor(F);
    require(MatMumpsSetIcntl(F, 14, spare));
    if (!definite)
    {
      require(MatMumpsSetIcntl(F, 13, 1)); // the last front on one rank, so that its pivots are counted
      require(MatMumpsSetIcntl(F, 24, 1)); // pivots of zero are found
    }
    require(MatCholeskyFactorSymbolic(F, A, nullptr, &info));
    PetscInt spare_now = 0;
    MatMumpsGetIcntl(F, 14, &spare_now);
    require_memory(ranks, F, available);
    require(MatCholeskyFactorNumeric(F, A, &info));
    MatFactorError error   = MAT_FACTOR_NOERROR;
    PetscInt       outcome = 0, negative = 0;
    require(MatFactorGetError(F, &error));
    MatMumpsGetInfog(F, 1, &outcome);
    MatMumpsGetInfog(F, 12, &negative);
    constexpr int work_array_too_small[] = {-8, -9, -14, -15, -17, -20};
    if (std::count(std::begin(work_array_too_small), std::end(work_array_too_small), outcome) &&
        spare < largest_spare && spare_now == spare) // not a value of PETSC_OPTIONS
      continue;
    if (error == MAT_FACTOR_OUTMEMORY)
      throw ConvergenceFailure("the factor of the stiffness by MUMPS does not fit into the memory; start more ranks on "
                               "more computers, keep it on disk "
                               "(PETSC_OPTIONS=\"-reduction_mat_mumps_icntl_22 1\"), or use a coarser mesh");
    constexpr int singular = -10, indefinite_root = -40;
    if (definite && (outcome == singular || outcome == indefinite_root || (outcome >= 0 && negative > 0)))
      return nullptr;
    if (error != MAT_FACTOR_NOERROR || outcome < 0)
      throw ConvergenceFailure("the factor of the stiffness: MUMPS failed with INFOG(1) = " + std::to_string(outcome) +
                               "; its manual names the cause");
    return factor;
  }
}

} // namespace gestell::coupling
