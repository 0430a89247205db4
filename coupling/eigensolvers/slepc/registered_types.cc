// The one file that sees the private headers of PETSc and SLEPc, as their own solvers do.
#include "coupling/eigensolvers/slepc/registered_types.h"

#include "coupling/algebra/sparse_cholesky.h"

#include <petsc/private/matimpl.h>
#include <slepc/private/epsimpl.h>

#include <cstring>

namespace gestell::coupling
{

namespace
{

using Eigen::MatrixXd;
using Columns      = Eigen::Map<MatrixXd, 0, Eigen::OuterStride<>>;
using ConstColumns = Eigen::Map<const MatrixXd, 0, Eigen::OuterStride<>>;
using SparseMatrix = Eigen::SparseMatrix<double>;

const ModeProblem &problem_of(Mat shell)
{
  const ModeProblem *problem = nullptr;
  MatShellGetContext(shell, &problem);
  return *problem;
}

/// Exceptions must not cross C: PETSc gets their message, and the problem keeps them for whoever called PETSc.
template <typename Work>
PetscErrorCode guarded(const ModeProblem *problem, const Work &work)
{
  try
  {
    work();
    return 0;
  }
  catch (const std::exception &error)
  {
    if (problem)
      problem->failure = std::current_exception();
    return PetscError(PETSC_COMM_SELF, __LINE__, __func__, __FILE__, PETSC_ERR_LIB, PETSC_ERROR_INITIAL, "%s",
                      error.what());
  }
}

/// work(numbers of x, numbers of y)
template <typename Work>
PetscErrorCode with_numbers(Vec x, Vec y, const Work &work)
{
  const PetscScalar *from = nullptr;
  PetscScalar       *to   = nullptr;
  PetscCall(VecGetArrayRead(x, &from));
  PetscCall(VecGetArrayWrite(y, &to));
  const PetscErrorCode code = work(from, to);
  PetscCall(VecRestoreArrayRead(x, &from));
  PetscCall(VecRestoreArrayWrite(y, &to));
  return code;
}

template <void (ModeProblem::*times)(const double *, double *) const>
PetscErrorCode multiply(Mat A, Vec x, Vec y)
{
  const ModeProblem &problem = problem_of(A);
  return with_numbers(
      x, y, [&](const double *from, double *to) { return guarded(&problem, [&] { (problem.*times)(from, to); }); });
}

PetscOwned<Mat> shell(MPI_Comm comm, const ModeProblem &problem, PetscErrorCode (*times)(Mat, Vec, Vec))
{
  Mat A = nullptr;
  require_petsc(MatCreateShell(comm, problem.rows(), problem.rows(), PETSC_DETERMINE, PETSC_DETERMINE,
                               const_cast<ModeProblem *>(&problem), &A),
                "modes");
  MatShellSetOperation(A, MATOP_MULT, reinterpret_cast<void (*)()>(times));
  MatSetOption(A, MAT_SYMMETRIC, PETSC_TRUE);
  return PetscOwned<Mat>(A);
}

// MatSolverType "gestell"

/// Data of this program in a factor of PETSc: the inverse of a problem, or the factor of a PETSc matrix.
struct OwnFactor
{
  const ModeProblem              *problem = nullptr;
  SparseMatrix                    A;
  std::unique_ptr<SparseCholesky> L;

  void solve(const ConstColumns &F, Columns X)
  {
    if (problem)
      return problem->solve(F, X);
    X = F;
    L->solve_in_place(X);
  }
};

OwnFactor &own(Mat F)
{
  return *static_cast<OwnFactor *>(F->data);
}

/// Both triangles of a symmetric matrix of PETSc.
PetscErrorCode read(Mat A, SparseMatrix &result)
{
  PetscInt           n     = 0;
  const PetscInt    *begin = nullptr, *column = nullptr;
  const PetscScalar *value = nullptr;
  PetscBool          done = PETSC_FALSE, upper = PETSC_FALSE;
  PetscCall(PetscObjectTypeCompare(PetscObject(A), MATSEQSBAIJ, &upper));
  Mat full = A;
  if (upper)
    PetscCall(MatConvert(A, MATSEQAIJ, MAT_INITIAL_MATRIX, &full));
  PetscCall(MatGetRowIJ(full, 0, PETSC_FALSE, PETSC_FALSE, &n, &begin, &column, &done));
  PetscCall(MatSeqAIJGetArrayRead(full, &value));
  result = Eigen::Map<const SparseMatrix>(n, n, begin[n], begin, column, value);
  PetscCall(MatSeqAIJRestoreArrayRead(full, &value));
  PetscCall(MatRestoreRowIJ(full, 0, PETSC_FALSE, PETSC_FALSE, &n, &begin, &column, &done));
  if (upper)
    PetscCall(MatDestroy(&full));
  return 0;
}

PetscErrorCode factor_symbolic(Mat F, Mat A, IS, const MatFactorInfo *)
{
  PetscBool is_shell = PETSC_FALSE;
  PetscCall(PetscObjectTypeCompare(PetscObject(A), MATSHELL, &is_shell));
  if (is_shell)
  {
    own(F).problem = &problem_of(A);
    return 0;
  }
  PetscCall(read(A, own(F).A));
  return guarded(nullptr,
                 [&] { own(F).L = std::make_unique<SparseCholesky>(SparseCholesky::without_numbers(own(F).A, {})); });
}

PetscErrorCode factor_numeric(Mat F, Mat A, const MatFactorInfo *)
{
  OwnFactor &factor  = own(F);
  F->assembled       = PETSC_TRUE;
  F->factorerrortype = MAT_FACTOR_NOERROR;
  if (factor.problem)
    return 0;
  PetscCall(read(A, factor.A));
  return guarded(nullptr,
                 [&]
                 {
                   try
                   {
                     factor.L->factorise(factor.A);
                   }
                   catch (const NotPositiveDefinite &failed)
                   {
                     F->factorerrortype             = MAT_FACTOR_NUMERIC_ZEROPIVOT;
                     F->factorerror_zeropivot_row   = failed.row;
                     F->factorerror_zeropivot_value = 0.;
                   }
                 });
}

PetscErrorCode solve(Mat F, Vec f, Vec x)
{
  PetscInt n = 0;
  PetscCall(VecGetLocalSize(f, &n));
  OwnFactor &factor = own(F);
  return with_numbers(f, x,
                      [&](const double *from, double *to)
                      {
                        return guarded(factor.problem,
                                       [&] {
                                         factor.solve(ConstColumns(from, n, 1, Eigen::OuterStride<>(n)),
                                                      Columns(to, n, 1, Eigen::OuterStride<>(n)));
                                       });
                      });
}

PetscErrorCode solve_columns(Mat F, Mat B, Mat X)
{
  PetscInt           n = 0, k = 0, from_step = 0, to_step = 0;
  const PetscScalar *from = nullptr;
  PetscScalar       *to   = nullptr;
  PetscCall(MatGetLocalSize(B, &n, nullptr));
  PetscCall(MatGetSize(B, nullptr, &k));
  PetscCall(MatDenseGetLDA(B, &from_step));
  PetscCall(MatDenseGetLDA(X, &to_step));
  PetscCall(MatDenseGetArrayRead(B, &from));
  PetscCall(MatDenseGetArrayWrite(X, &to));
  OwnFactor           &factor = own(F);
  const PetscErrorCode code   = guarded(factor.problem,
                                        [&]
                                        {
                                        factor.solve(ConstColumns(from, n, k, Eigen::OuterStride<>(from_step)),
                                                       Columns(to, n, k, Eigen::OuterStride<>(to_step)));
                                      });
  PetscCall(MatDenseRestoreArrayRead(B, &from));
  PetscCall(MatDenseRestoreArrayWrite(X, &to));
  return code;
}

/// Numbers of negative, zero and positive eigenvalues of a PETSc matrix.
PetscErrorCode inertia(Mat F, PetscInt *negative, PetscInt *zero, PetscInt *positive)
{
  OwnFactor &factor = own(F);
  PetscCheck(factor.L, PETSC_COMM_SELF, PETSC_ERR_SUP, "the inertia is available for assembled matrices only");
  int below = 0;
  PetscCall(guarded(nullptr, [&] { below = factor.L->inertia(factor.A, factor.A, 0.).negative; }));
  if (negative)
    *negative = below;
  if (zero)
    *zero = 0;
  if (positive)
    *positive = factor.L->size() - below;
  return 0;
}

PetscErrorCode describe(Mat F, MatInfoType, MatInfo *info)
{
  std::memset(info, 0, sizeof *info);
  if (own(F).L)
    info->nz_used = own(F).L->entries();
  return 0;
}

PetscErrorCode destroy_factor(Mat F)
{
  delete static_cast<OwnFactor *>(F->data);
  F->data = nullptr;
  return 0;
}

PetscErrorCode make_factor(Mat A, MatFactorType kind, Mat *result)
{
  Mat F = nullptr;
  PetscCall(MatCreate(PetscObjectComm(PetscObject(A)), &F));
  PetscCall(MatSetSizes(F, A->rmap->n, A->cmap->n, A->rmap->N, A->cmap->N));
  PetscCall(PetscStrallocpy(own_factor, &PetscObject(F)->type_name));
  PetscCall(MatSetUp(F));
  F->data                        = new OwnFactor;
  F->factortype                  = kind;
  F->preallocated                = PETSC_TRUE;
  F->ops->choleskyfactorsymbolic = factor_symbolic;
  F->ops->choleskyfactornumeric  = factor_numeric;
  F->ops->solve                  = solve;
  F->ops->matsolve               = solve_columns;
  F->ops->getinertia             = inertia;
  F->ops->getinfo                = describe;
  F->ops->destroy                = destroy_factor;
  PetscCall(PetscFree(F->solvertype));
  PetscCall(PetscStrallocpy(own_factor, &F->solvertype));
  *result = F;
  return 0;
}

// EPSType "block-lanczos"

struct OwnSearch
{
  BlockLanczos::Options         options;
  LowestModes                   known;
  std::unique_ptr<ModeProblem>  assembled; // of matrices of PETSc
  SparseMatrix                  M;         // the same
  const ModeProblem            *problem = nullptr;
  std::unique_ptr<BlockLanczos> lanczos;

  const ModeProblem *caller() const { return assembled ? nullptr : problem; }
};

OwnSearch &own(EPS eps)
{
  return *static_cast<OwnSearch *>(eps->data);
}

/// All columns at once through whatever solves in the spectral transformation.
PetscErrorCode solve_by_transformation(ST st, Eigen::Ref<MatrixXd> X)
{
  MatrixXd F = X, solution(X.rows(), X.cols());
  Mat      f = nullptr, x = nullptr;
  PetscCall(MatCreateSeqDense(PETSC_COMM_SELF, int(F.rows()), int(F.cols()), F.data(), &f));
  PetscCall(MatCreateSeqDense(PETSC_COMM_SELF, int(F.rows()), int(F.cols()), solution.data(), &x));
  PetscCall(STMatMatSolve(st, f, x));
  PetscCall(MatDestroy(&f));
  PetscCall(MatDestroy(&x));
  X = solution;
  return 0;
}

/// Finds the problem of the operators: one of this program, or one made of PETSc matrices in one process.
PetscErrorCode find_problem(EPS eps)
{
  OwnSearch &search = own(eps);
  Mat        A = nullptr, B = nullptr;
  PetscBool  is_shell = PETSC_FALSE;
  PetscCall(EPSGetOperators(eps, &A, &B));
  PetscCall(PetscObjectTypeCompare(PetscObject(A), MATSHELL, &is_shell));
  if (is_shell)
    search.problem = &problem_of(A);
  if (search.problem)
    return 0;
  PetscCall(read(B, search.M));
  auto columns =
      std::make_shared<InverseByColumns>(int(search.M.rows()), [st = eps->st](Eigen::Ref<MatrixXd> X)
                                         { require_petsc(solve_by_transformation(st, X), "block-lanczos"); });
  search.assembled = std::make_unique<ModeProblem>(columns, search.M, nullptr);
  search.problem   = search.assembled.get();
  return 0;
}

PetscErrorCode make_room(EPS eps, PetscInt count)
{
  eps->ncv = eps->mpd = count;
  return EPSAllocateSolution(eps, 0);
}

PetscErrorCode set_up_search(EPS eps)
{
  EPSCheckHermitianDefinite(eps);
  EPSCheckSinvert(eps);
  PetscCheck(eps->target == 0., PetscObjectComm(PetscObject(eps)), PETSC_ERR_SUP,
             "block-lanczos finds the eigenvalues next to the target 0");
  return make_room(eps, eps->nev);
}

/// Nothing is left to do: omega^2 are written, not 1 / omega^2.
PetscErrorCode transform_back(EPS)
{
  return 0;
}

PetscErrorCode sort_ascending(EPS eps)
{
  eps->sc->comparison    = SlepcCompareSmallestReal;
  eps->sc->comparisonctx = nullptr;
  eps->sc->map           = nullptr;
  eps->sc->mapobj        = nullptr;
  eps->sc->rg            = nullptr;
  return 0;
}

PetscErrorCode search_modes(EPS eps)
{
  OwnSearch &search = own(eps);
  PetscCall(find_problem(eps));
  LowestModes found;
  PetscCall(guarded(search.caller(),
                    [&]
                    {
                      if (!search.lanczos)
                        search.lanczos = std::make_unique<BlockLanczos>(search.problem->M(), search.problem->inverse(),
                                                                        search.options, search.known);
                      search.lanczos->find(eps->nev);
                      found = search.lanczos->values(search.lanczos->gap_above(eps->nev).below);
                    }));
  eps->nconv = int(found.omega.size());
  if (eps->nconv > eps->ncv)
    PetscCall(make_room(eps, eps->nconv));
  for (PetscInt j = 0; j < eps->nconv; ++j)
  {
    eps->eigr[j]   = found.omega(j) * found.omega(j);
    eps->eigi[j]   = 0.;
    eps->perm[j]   = j;
    eps->errest[j] = 2. * found.bound(j);
  }
  eps->its    = search.lanczos->n_vectors() / search.options.block;
  eps->reason = EPS_CONVERGED_TOL;
  return 0;
}

/// Writes the vectors into the BV when they are requested.
PetscErrorCode give_vectors(EPS eps)
{
  OwnSearch &search = own(eps);
  MatrixXd   V;
  PetscCall(guarded(search.caller(), [&] { V = search.lanczos->modes(eps->nconv).V; }));
  Mat          columns = nullptr;
  PetscScalar *to      = nullptr;
  PetscInt     step    = 0; // a BV may have gaps between its columns
  PetscCall(BVSetActiveColumns(eps->V, 0, eps->nconv));
  PetscCall(BVGetMat(eps->V, &columns));
  PetscCall(MatDenseGetLDA(columns, &step));
  PetscCall(MatDenseGetArrayWrite(columns, &to));
  Columns(to, search.problem->rows(), V.cols(), Eigen::OuterStride<>(step)) = V(search.problem->free(), Eigen::all);
  PetscCall(MatDenseRestoreArrayWrite(columns, &to));
  return BVRestoreMat(eps->V, &columns);
}

PetscErrorCode destroy_search(EPS eps)
{
  delete static_cast<OwnSearch *>(eps->data);
  eps->data = nullptr;
  return 0;
}

PetscErrorCode make_search(EPS eps)
{
  eps->data                = new OwnSearch;
  eps->useds               = PETSC_FALSE;
  eps->categ               = EPS_CATEGORY_OTHER;
  eps->ops->setup          = set_up_search;
  eps->ops->setupsort      = sort_ascending;
  eps->ops->solve          = search_modes;
  eps->ops->backtransform  = transform_back;
  eps->ops->computevectors = give_vectors;
  eps->ops->destroy        = destroy_search;
  return 0;
}

} // namespace

void register_own_types()
{
  [[maybe_unused]] static const bool done = []
  {
    require_petsc(MatInitializePackage(), "gestell's factor"); // else the first one registered replaces PETSc's own
    for (const char *matrix : {MATSHELL, MATSEQAIJ, MATSEQSBAIJ})
      require_petsc(MatSolverTypeRegister(own_factor, matrix, MAT_FACTOR_CHOLESKY, make_factor), "gestell's factor");
    require_petsc(EPSRegister(own_block_lanczos, make_search), "block-lanczos");
    return true;
  }();
}

PetscOwned<Mat> stiffness_operator(MPI_Comm comm, const ModeProblem &problem)
{
  return shell(comm, problem, multiply<&ModeProblem::stiffness_times>);
}

PetscOwned<Mat> mass_operator(MPI_Comm comm, const ModeProblem &problem)
{
  return shell(comm, problem, multiply<&ModeProblem::mass_times>);
}

void *data_of_factor(Mat factor)
{
  return factor->data;
}

void set_block_lanczos(EPS eps, const BlockLanczos::Options &options, const LowestModes &known)
{
  own(eps).options = options;
  own(eps).known   = known;
}

const BlockLanczos &block_lanczos_of(EPS eps)
{
  return *own(eps).lanczos;
}

} // namespace gestell::coupling
