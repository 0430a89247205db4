#include "coupling/parallel/shared_held_frame.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <string>

namespace gestell::coupling
{

namespace
{

using Kind = fem::AgreedFailure::Kind;

constexpr double tolerance     = 1e-10; // relative residual of 1 / omega^2; the frequencies are far better
constexpr int    max_restarts  = 100;
constexpr int    spare_vectors = 20; // of the Krylov space beyond the modes wanted, at least

/// What PETSc calls back, and what it threw, since exceptions must not cross C.
struct Inverse
{
  SharedHeldFrame   *frame;
  std::exception_ptr failure;
};

PetscErrorCode apply_inverse(PC pc, Vec f, Vec x)
{
  void *context = nullptr;
  PCShellGetContext(pc, &context);
  auto &inverse = *static_cast<Inverse *>(context);
  try
  {
    inverse.frame->solve(f, x);
  }
  catch (...)
  {
    inverse.failure = std::current_exception();
    return PETSC_ERR_LIB;
  }
  return 0;
}

void use_inverse(EPS eps, Inverse &inverse)
{
  ST  st  = nullptr;
  KSP ksp = nullptr;
  PC  pc  = nullptr;
  EPSGetST(eps, &st);
  STSetType(st, STSINVERT);
  STGetKSP(st, &ksp);
  KSPSetType(ksp, KSPPREONLY);
  KSPGetPC(ksp, &pc);
  PCSetType(pc, PCSHELL);
  PCShellSetContext(pc, &inverse);
  PCShellSetApply(pc, apply_inverse);
}

void require_positive(double square, int mode)
{
  if (!(square > 0.))
    throw fem::AgreedFailure(Kind::method, "lowest_modes: mode " + std::to_string(mode) +
                                               " has omega^2 = " + std::to_string(square) +
                                               "; the stiffness matrix must be positive definite");
}

} // namespace

LowestModes SharedHeldFrame::lowest_modes(int count, const Eigen::Ref<const Eigen::MatrixXd> &known)
{
  const QuietPetsc quiet;
  int              n_known = int(known.cols());
  matrices_->ranks().broadcast(count);
  matrices_->ranks().broadcast(n_known);
  factorise();

  EPS handle = nullptr;
  require_petsc(EPSCreate(fem::Ranks::comm(), &handle), "lowest_modes");
  const PetscOwned<EPS> eps(handle);
  Inverse               inverse{this, nullptr};
  EPSSetOperators(handle, matrices_->C(), matrices_->M());
  EPSSetProblemType(handle, EPS_GHEP);
  EPSSetType(handle, EPSKRYLOVSCHUR);
  EPSSetWhichEigenpairs(handle, EPS_TARGET_MAGNITUDE);
  EPSSetTarget(handle, 0.);
  EPSSetPurify(handle, PETSC_FALSE); // one solution per mode, for directions without mass only
  EPSSetTolerances(handle, tolerance, max_restarts);
  EPSSetDimensions(handle, count, std::min(matrices_->n(), count + std::max(count, spare_vectors)), PETSC_DEFAULT);
  use_inverse(handle, inverse);

  std::vector<PetscOwned<Vec>> views;
  std::vector<Vec>             deflated;
  for (int j = 0; j < n_known; ++j)
  {
    views.push_back(matrices_->vector());
    deflated.push_back(views.back().get());
    matrices_->deal_out(j < known.cols() ? known.col(j).data() : nullptr, deflated.back());
  }
  if (n_known > 0)
    require_petsc(EPSSetDeflationSpace(handle, n_known, deflated.data()), "lowest_modes");

  const PetscOwned<Vec> start = irregular_motion(), shape = matrices_->vector();
  Vec                   starts[] = {start.get()};
  EPSSetInitialSpace(handle, 1, starts);

  const PetscErrorCode code = EPSSolve(handle);
  if (inverse.failure)
    std::rethrow_exception(inverse.failure);
  require_petsc(code, "lowest_modes: SLEPc");

  int found = 0;
  EPSGetConverged(handle, &found);
  count = std::min(count, found);
  LowestModes modes{Eigen::VectorXd(count), Eigen::MatrixXd(matrices_->row_of().size(), count), Eigen::VectorXd(count)};
  for (int j = 0; j < count; ++j)
  {
    double square = 0.;
    require_petsc(EPSGetEigenpair(handle, j, &square, nullptr, shape.get(), nullptr), "lowest_modes");
    require_positive(square, j + 1);
    modes.omega(j) = std::sqrt(square);
    EPSGetErrorEstimate(handle, j, &modes.bound(j)); // of 1 / omega^2, relative
    modes.bound(j) *= 0.5;
    matrices_->collect(shape.get(), modes.V.col(j).data());
  }
  return modes;
}

} // namespace gestell::coupling
