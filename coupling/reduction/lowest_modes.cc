#include "coupling/reduction/lowest_modes.h"

#include "coupling/integration/second_order_system.h"
#include "fem/petsc_session.h"

#include <slepceps.h>

#include <cmath>
#include <exception>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

namespace gestell::coupling
{

namespace
{

using Eigen::MatrixXd;

constexpr double tolerance     = 1e-10; // relative residual of 1 / omega^2; the frequencies are far better
constexpr int    max_restarts  = 100;
constexpr int    spare_vectors = 20; // of the Krylov space beyond the modes wanted, at least

void require_success(PetscErrorCode code)
{
  if (code == 0)
    return;
  const char *text = nullptr;
  PetscErrorMessage(code, &text, nullptr);
  throw ConvergenceFailure("eigenvalue solver SLEPc failed with error " + std::to_string(code) +
                           (text ? std::string(": ") + text : std::string()));
}

/// PETSc objects that destroy themselves.
struct Destroy
{
  void operator()(Mat x) const { MatDestroy(&x); }
  void operator()(Vec x) const { VecDestroy(&x); }
  void operator()(EPS x) const { EPSDestroy(&x); }
};
template <typename T>
using Owned = std::unique_ptr<std::remove_pointer_t<T>, Destroy>;

/// While it lives PETSc returns its errors and prints nothing.
struct QuietErrors
{
  QuietErrors() { PetscPushErrorHandler(PetscReturnErrorHandler, nullptr); }
  ~QuietErrors() { PetscPopErrorHandler(); }
};

/// What PETSc calls back: the solver, and what it threw, since exceptions must not cross C.
struct Inverse
{
  const InverseStiffness *solve;
  std::exception_ptr      failure;
};

PetscErrorCode apply_inverse(PC pc, Vec f, Vec x)
{
  void *context;
  PCShellGetContext(pc, &context);
  auto              &inverse = *static_cast<Inverse *>(context);
  const PetscScalar *from;
  PetscScalar       *to;
  VecGetArrayRead(f, &from);
  VecGetArray(x, &to);
  PetscErrorCode code = 0;
  try
  {
    (*inverse.solve)(from, to);
  }
  catch (...)
  {
    inverse.failure = std::current_exception();
    code            = PETSC_ERR_LIB;
  }
  VecRestoreArray(x, &to);
  VecRestoreArrayRead(f, &from);
  return code;
}

/// PETSc's view of a symmetric Eigen matrix: columns read as rows, nothing copied.
Owned<Mat> view_of(const Eigen::SparseMatrix<double> &A)
{
  static_assert(std::is_same<PetscInt, int>::value && std::is_same<PetscScalar, double>::value,
                "PETSc must be built with 32-bit indices and real double numbers");
  Mat view;
  require_success(MatCreateSeqAIJWithArrays(PETSC_COMM_SELF, A.rows(), A.cols(), const_cast<int *>(A.outerIndexPtr()),
                                            const_cast<int *>(A.innerIndexPtr()), const_cast<double *>(A.valuePtr()),
                                            &view));
  MatSetOption(view, MAT_SYMMETRIC, PETSC_TRUE);
  return Owned<Mat>(view);
}

Owned<Vec> view_of(double *x, int n)
{
  Vec view;
  require_success(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, n, x, &view));
  return Owned<Vec>(view);
}

/// Any vector with a share of every mode that the solver's holding allows: C^-1 M x, x irregular but always the same.
Eigen::VectorXd start_vector(const Eigen::SparseMatrix<double> &M, const InverseStiffness &inverse)
{
  const auto      n = M.rows();
  Eigen::VectorXd x(n), start(n);
  for (Eigen::Index i = 0; i < n; ++i)
    x(i) = std::fmod(0.6180339887498949 * double(i + 1), 1.) - 0.3;
  x = (M * x).eval();
  inverse(x.data(), start.data());
  return start;
}

void use_inverse(EPS eps, Inverse &inverse)
{
  ST  st;
  KSP ksp;
  PC  pc;
  EPSGetST(eps, &st);
  STSetType(st, STSINVERT);
  STGetKSP(st, &ksp);
  KSPSetType(ksp, KSPPREONLY);
  KSPGetPC(ksp, &pc);
  PCSetType(pc, PCSHELL);
  PCShellSetContext(pc, &inverse);
  PCShellSetApply(pc, apply_inverse);
}

/// Keeps the search orthogonal, in M, to the modes found before.
void deflate(EPS eps, const Eigen::Ref<const MatrixXd> &known)
{
  std::vector<Owned<Vec>> views;
  std::vector<Vec>        vectors;
  for (Eigen::Index j = 0; j < known.cols(); ++j)
  {
    views.push_back(view_of(const_cast<double *>(known.col(j).data()), int(known.rows())));
    vectors.push_back(views.back().get());
  }
  if (!vectors.empty())
    require_success(EPSSetDeflationSpace(eps, int(vectors.size()), vectors.data()));
}

LowestModes read_modes(EPS eps, int count, int n)
{
  PetscInt found = 0;
  EPSGetConverged(eps, &found);
  if (found < count)
    throw ConvergenceFailure("lowest_modes: " + std::to_string(found) + " of " + std::to_string(count) +
                             " modes converged in " + std::to_string(max_restarts) +
                             " restarts; ask for fewer modes, or check that the structure has that many with mass");
  LowestModes modes{Eigen::VectorXd(count), MatrixXd(n, count)};
  for (int j = 0; j < count; ++j)
  {
    PetscScalar      square;
    const Owned<Vec> shape = view_of(modes.V.col(j).data(), n);
    require_success(EPSGetEigenpair(eps, j, &square, nullptr, shape.get(), nullptr));
    if (!(square > 0.))
      throw ConvergenceFailure("lowest_modes: mode " + std::to_string(j + 1) + " has omega^2 = " +
                               std::to_string(square) + "; the stiffness matrix must be positive definite");
    modes.omega(j) = std::sqrt(square);
  }
  return modes;
}

} // namespace

LowestModes lowest_modes(const Eigen::SparseMatrix<double> &C, const Eigen::SparseMatrix<double> &M,
                         const InverseStiffness &inverse, int count, const Eigen::Ref<const MatrixXd> &known)
{
  const int n = int(M.rows());
  if (count == 0)
    return {Eigen::VectorXd(0), MatrixXd(n, 0)};
  fem::petsc_session();
  const QuietErrors quiet;

  const Owned<Mat> mass = view_of(M), stiffness = view_of(C);

  EPS handle;
  require_success(EPSCreate(PETSC_COMM_SELF, &handle));
  const Owned<EPS> eps(handle);
  Inverse          context{&inverse, nullptr};
  EPSSetOperators(handle, stiffness.get(), mass.get());
  EPSSetProblemType(handle, EPS_GHEP);
  EPSSetType(handle, EPSKRYLOVSCHUR);
  EPSSetWhichEigenpairs(handle, EPS_TARGET_MAGNITUDE);
  EPSSetTarget(handle, 0.);
  EPSSetPurify(handle, PETSC_FALSE); // one solution per mode, for directions without mass only
  EPSSetTolerances(handle, tolerance, max_restarts);
  EPSSetDimensions(handle, count, std::min(n, count + std::max(count, spare_vectors)), PETSC_DEFAULT);
  use_inverse(handle, context);
  deflate(handle, known);

  Eigen::VectorXd  start      = start_vector(M, inverse);
  const Owned<Vec> start_view = view_of(start.data(), n);
  Vec              starts[]   = {start_view.get()};
  EPSSetInitialSpace(handle, 1, starts);

  const PetscErrorCode code = EPSSolve(handle);
  if (context.failure)
    std::rethrow_exception(context.failure);
  require_success(code);
  return read_modes(handle, count, n);
}

} // namespace gestell::coupling
