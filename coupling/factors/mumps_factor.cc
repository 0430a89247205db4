#include "coupling/factors/mumps_factor.h"

#include "coupling/algebra/large_array.h"
#include "coupling/algebra/sparse_cholesky.h"
#include "coupling/eigensolvers/slepc/registered_types.h"
#include "coupling/integration/system/convergence_failure.h"

#include <dmumps_c.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <memory>
#include <new>
#include <numeric>
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

/// The data of MUMPS, with which those of PETSc begin; null if they are not where its header expects them.
DMUMPS_STRUC_C *data_of_mumps(Mat F)
{
  auto *const mumps   = static_cast<DMUMPS_STRUC_C *>(data_of_factor(F));
  PetscInt    outcome = 0;
  MatMumpsGetInfog(F, 1, &outcome);
  return mumps->infog[0] == outcome && mumps->version_number == std::string(MUMPS_VERSION) ? mumps : nullptr;
}

/// Returns whole pages of an array to the system; it may be freed later, but not read.
template <typename T>
void return_pages(T *array, std::int64_t size)
{
  const auto page  = std::uintptr_t(sysconf(_SC_PAGESIZE));
  const auto first = (std::uintptr_t(array) + page - 1) / page * page, end = std::uintptr_t(array + size) / page * page;
  if (array && first < end)
    madvise(reinterpret_cast<void *>(first), end - first, MADV_DONTNEED);
}

/// The share of A as triplets, which PETSc copies and stores as long as the factor: MUMPS reads them again only for
/// iterative refinement and its error, options of the user.
void return_triplets(Mat F)
{
  const DMUMPS_STRUC_C *const mumps = data_of_mumps(F);
  if (!mumps || mumps->icntl[9] != 0 || mumps->icntl[10] != 0)
    return;
  return_pages(mumps->irn, mumps->nnz);
  return_pages(mumps->jcn, mumps->nnz);
  return_pages(mumps->a, mumps->nnz);
  return_pages(mumps->irn_loc, mumps->nnz_loc);
  return_pages(mumps->jcn_loc, mumps->nnz_loc);
  return_pages(mumps->a_loc, mumps->nnz_loc);
}

/**
 * Analysis for elimination in the order of the rows.  PETSc has no way to ask for it: with input by elements, of which
 * there are none, it prepares the data of MUMPS, which then refuses; MUMPS is called once more, with the order.
 *
 * @returns false, with nothing analysed, if the data are not where MUMPS' header expects them.
 */
bool analyse_in_order(Mat F, Mat A, const MatFactorInfo &info)
{
  constexpr int by_elements = 5, no_element = -24, order = 7, automatic = 7, given = 1;
  require(MatMumpsSetIcntl(F, by_elements, 1));
  require(MatCholeskyFactorSymbolic(F, A, nullptr, &info));
  DMUMPS_STRUC_C *const mumps = data_of_mumps(F);
  PetscInt              rows  = 0;
  MatGetSize(A, &rows, nullptr);
  if (!mumps || mumps->infog[0] != no_element || mumps->n != rows)
    return false;
  mumps->icntl[by_elements - 1] = 0;
  if (mumps->icntl[order - 1] == automatic) // no option of the user
  {
    mumps->icntl[order - 1] = given;
    require(PetscMalloc1(rows, &mumps->perm_in)); // PETSc frees it
    std::iota(mumps->perm_in, mumps->perm_in + rows, 1);
  }
  mumps->job = 1;
  dmumps_c(mumps);
  MatFactorClearError(F);
  return true;
}

/// Numbers counted by an INFO of MUMPS: in millions, if negative.
std::int64_t count_of(int info)
{
  return info < 0 ? -std::int64_t(info) * 1000000 : info;
}

/**
 * The working memory of MUMPS as an array that belongs to the factor: after the factorisation its end can be returned.
 *
 * @returns null where it is small, or options of the user store the factor in another way.
 */
LargeArray *given_memory(Mat F, int spare)
{
  DMUMPS_STRUC_C *const mumps   = data_of_mumps(F);
  constexpr int         on_disk = 22, limit = 23, discarded = 31, low_rank = 35;
  constexpr double      worthwhile = 1e6; // numbers
  double                size       = mumps ? double(count_of(mumps->info[7])) : 0.;
  for (const int option : {on_disk, limit, discarded, low_rank})
    if (mumps && mumps->icntl[option - 1] != 0)
      size = 0.;
  const double                millions = std::ceil(1e-6 * size * (1. + 0.01 * spare)) + 1.;
  std::unique_ptr<LargeArray> array;
  try
  {
    if (size >= worthwhile)
      array = std::make_unique<LargeArray>(std::size_t(1e6 * millions));
  }
  catch (const std::bad_alloc &) // MUMPS says so better
  {
  }
  double least = array ? size : 0.;
  MPI_Allreduce(MPI_IN_PLACE, &least, 1, MPI_DOUBLE, MPI_MIN, PetscObjectComm(PetscObject(F)));
  if (least < worthwhile)
    return nullptr;
  auto *const memory   = array.release();
  mumps->wk_user       = memory->data();
  mumps->lwk_user      = -int(millions);
  PetscContainer owner = nullptr;
  require(PetscContainerCreate(PETSC_COMM_SELF, &owner));
  PetscContainerSetPointer(owner, memory);
  PetscContainerSetUserDestroy(owner,
                               [](void *array) -> PetscErrorCode
                               {
                                 delete static_cast<LargeArray *>(array);
                                 return 0;
                               });
  PetscObjectCompose(PetscObject(F), "working memory", PetscObject(owner));
  PetscContainerDestroy(&owner);
  return memory;
}

/// Returns the end of the working memory, behind the factor.
/// @returns whether a solution is the same after it: the factor does not lie there.
bool return_end(Mat F, Mat A, LargeArray &memory)
{
  Vec load = nullptr, before = nullptr, after = nullptr;
  require(MatCreateVecs(A, &before, &load));
  require(VecDuplicate(before, &after));
  const PetscOwned<Vec> owned[] = {PetscOwned<Vec>(load), PetscOwned<Vec>(before), PetscOwned<Vec>(after)};
  require(VecSetRandom(load, nullptr));
  require(MatSolve(F, load, before));
  const DMUMPS_STRUC_C &mumps = *data_of_mumps(F);
  return_pages(memory.data() + count_of(mumps.info[8]), count_of(mumps.lwk_user) - count_of(mumps.info[8]));
  require(MatSolve(F, load, after));
  PetscReal size = 0., difference = 0.;
  VecNorm(before, NORM_2, &size);
  VecAXPY(after, -1., before);
  VecNorm(after, NORM_2, &difference);
  constexpr double rounding = 1e-4; // relative: far above that of a stiffness, far below that of a missing part
  return difference <= rounding * size;
}

/// A factor that is analysed.
PetscOwned<Mat> analysed(Mat A, bool definite, int spare, bool in_order = true)
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
  MatFactorInfo info;
  MatFactorInfoInitialize(&info);
  if (!in_order)
    require(MatCholeskyFactorSymbolic(F, A, nullptr, &info));
  else if (!analyse_in_order(F, A, info))
    return analysed(A, definite, spare, false);
  return factor;
}

} // namespace

PetscOwned<Mat> mumps_factor(const fem::Ranks &ranks, Mat A, bool definite, double available)
{
  require(MatSetOption(A, MAT_SPD, definite ? PETSC_TRUE : PETSC_FALSE));
  require(MatSetOptionsPrefixFactor(A, matrix_prefix));
  constexpr int first_spare = 30, largest_spare = 1000; // [%] of working memory beyond the estimate of the analysis
  bool          in_given = true;
  for (int spare = first_spare;; spare *= 2)
  {
    auto      factor    = analysed(A, definite, spare);
    const Mat F         = factor.get();
    PetscInt  spare_now = 0;
    MatMumpsGetIcntl(F, 14, &spare_now);
    require_memory(ranks, F, available);
    LargeArray   *memory = in_given ? given_memory(F, spare_now) : nullptr;
    MatFactorInfo info;
    MatFactorInfoInitialize(&info);
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
    constexpr int analysis_out_of_memory = -7;
    if (error == MAT_FACTOR_OUTMEMORY || outcome == analysis_out_of_memory)
      throw ConvergenceFailure("the factor of the stiffness by MUMPS does not fit into the memory; start more ranks on "
                               "more computers, keep it on disk "
                               "(PETSC_OPTIONS=\"-reduction_mat_mumps_icntl_22 1\"), or use a coarser mesh");
    constexpr int singular = -10, indefinite_root = -40;
    if (definite && (outcome == singular || outcome == indefinite_root || (outcome >= 0 && negative > 0)))
      return nullptr;
    if (error != MAT_FACTOR_NOERROR || outcome < 0)
      throw ConvergenceFailure("the factor of the stiffness: MUMPS failed with INFOG(1) = " + std::to_string(outcome) +
                               "; its manual names the cause");
    return_triplets(F);
    if (!memory || return_end(F, A, *memory))
      return factor;
    in_given = false; // MUMPS has parts of its factor elsewhere
  }
}

} // namespace gestell::coupling
