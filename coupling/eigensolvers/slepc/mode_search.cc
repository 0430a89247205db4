#include "coupling/eigensolvers/slepc/mode_search.h"

#include "coupling/eigensolvers/block_lanczos.h"
#include "coupling/eigensolvers/slepc/registered_types.h"
#include "coupling/integration/system/convergence_failure.h"
#include "fem/parallel/petsc_session.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <new>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace gestell::coupling
{

namespace
{

/// A search that restarts for further modes, orthogonal to the known ones, as SLEPc does.
class DeflatedSearch final : public ModeSearch
{
public:
  /// Finds the lowest `count` modes in addition to the known ones; fewer if there are no more.
  using Further = std::function<LowestModes(int count, const Eigen::MatrixXd &known)>;

  /// @param n       rows of the modes
  /// @param n_free  modes there are at most
  /// @param known   modes found elsewhere, or none.
  DeflatedSearch(int n, int n_free, Further further, LowestModes known);

  void        find(int count) override;
  LowestModes modes(int count) const override;
  Gap         gap_above(int count) const override;

private:
  int gap_index(int count) const;

  int         n_free_;
  Further     further_;
  LowestModes found_;
  bool        exhausted_ = false; // the last search found fewer modes than requested
};

/// Both, in ascending order.
LowestModes joined(const LowestModes &a, const LowestModes &b)
{
  if (a.omega.size() == 0 || b.omega.size() == 0)
    return a.omega.size() == 0 ? b : a;
  const auto       n = a.V.rows(), m = a.omega.size() + b.omega.size();
  Eigen::VectorXd  omega(m), bound(m);
  Eigen::MatrixXd  V(n, m);
  std::vector<int> order(m);
  omega << a.omega, b.omega;
  bound << a.bound, b.bound;
  V << a.V, b.V;
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int i, int j) { return omega(i) < omega(j); });
  return {omega(order), V(Eigen::all, order), bound(order)};
}

DeflatedSearch::DeflatedSearch(int n, int n_free, Further further, LowestModes known)
    : n_free_(n_free), further_(std::move(further)), found_(std::move(known))
{
  if (found_.omega.size() == 0)
    found_ = {Eigen::VectorXd(0), Eigen::MatrixXd(n, 0), Eigen::VectorXd(0)};
}

void DeflatedSearch::find(int count)
{
  constexpr int beyond = 4; // further modes, in which a gap is sought
  const int     most   = std::min(count + beyond, n_free_);
  while (int(found_.omega.size()) < most && !exhausted_)
  {
    const int wanted = most - int(found_.omega.size());
    auto      more   = further_(wanted, found_.V);
    exhausted_       = int(more.omega.size()) < wanted;
    found_           = joined(found_, more);
  }
  if (found_.omega.size() < count)
    throw ConvergenceFailure("lowest modes: " + std::to_string(found_.omega.size()) + " of " + std::to_string(count) +
                             " are found; request fewer modes: the mass matrix of the internal DOFs has no higher "
                             "rank, or a part is almost unsupported");
}

LowestModes DeflatedSearch::modes(int count) const
{
  if (count > found_.omega.size())
    throw std::logic_error("DeflatedSearch::modes: only " + std::to_string(found_.omega.size()) + " are found");
  return {found_.omega.head(count), found_.V.leftCols(count), found_.bound.head(count)};
}

/// Number of modes below the first gap that is wide enough, or else the widest.
int DeflatedSearch::gap_index(int count) const
{
  int    widest = count;
  double width  = 0.;
  for (int i = count; i < found_.omega.size(); ++i)
  {
    const double here = found_.omega(i) / found_.omega(i - 1) - 1.;
    if (here > width)
      widest = i, width = here;
    constexpr double gap_for_shift = 1e-3; // relative distance of two frequencies sufficient for a shift between them
    if (here > gap_for_shift)
      break;
  }
  return widest;
}

ModeSearch::Gap DeflatedSearch::gap_above(int count) const
{
  if (count > found_.omega.size())
    throw std::logic_error("DeflatedSearch: call find() first");
  if (count == 0)
    return {0., found_.omega.size() > 0 ? found_.omega(0) : INFINITY, 0};
  const int i = gap_index(count);
  return {found_.omega(i - 1), i < found_.omega.size() ? found_.omega(i) : INFINITY, i};
}

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr const char *prefix = "reduction_";

/// Rethrows the exception of a callback; otherwise throws the error of PETSc.
void require_done(const ModeProblem &problem, PetscErrorCode code, const std::string &eigensolver)
{
  if (problem.failure)
    std::rethrow_exception(std::exchange(problem.failure, nullptr));
  if (code == 0)
    return;
  if (code == PETSC_ERR_MEM)
    throw std::bad_alloc(); // of one rank, perhaps
  throw ConvergenceFailure("reduction: the eigensolver " + eigensolver + " failed: " + QuietPetsc::message() +
                           " (PETSc, error " + std::to_string(code) +
                           "); check reduction.eigensolver and PETSC_OPTIONS");
}

/// A problem of modes in the hands of SLEPc.
class EigenSolver
{
public:
  EigenSolver(MPI_Comm comm, const ModeProblem &problem, std::string name) : problem_(problem), name_(std::move(name))
  {
    const QuietPetsc quiet;
    C_      = stiffness_operator(comm, problem_);
    M_      = mass_operator(comm, problem_);
    EPS eps = nullptr;
    require(EPSCreate(comm, &eps));
    eps_.reset(eps);
    require(EPSSetOperators(eps, C_.get(), M_.get()));
    require(EPSSetProblemType(eps, EPS_GHEP));
    require(EPSSetOptionsPrefix(eps, prefix));
    require(EPSSetType(eps, slepc_name().c_str()));
    require(EPSSetPurify(eps, PETSC_FALSE)); // one solution per mode, for directions without mass only
    if (is(EPSLOBPCG))                       // a block returns a mode twice where its Gram matrix is almost singular
      require(EPSLOBPCGSetBlockSize(eps, 1));
    constexpr double tolerance    = 1e-10; // relative residual of 1 / omega^2; the frequencies are far better
    constexpr int    max_restarts = 1000;  // a safety net: searches end after some tens, or not at all
    require(EPSSetTolerances(eps, tolerance, max_restarts));
    require(EPSSetFromOptions(eps));
    set_transformation();
  }

  EPS get() const { return eps_.get(); }
  int size() const
  {
    PetscInt n = 0;
    MatGetSize(M_.get(), &n, nullptr);
    return n;
  }
  void require(PetscErrorCode code) const { require_done(problem_, code, name_); }
  bool is(const char *type) const
  {
    PetscBool same = PETSC_FALSE;
    PetscObjectTypeCompare(PetscObject(eps_.get()), type, &same);
    return same;
  }

  void solve(int count)
  {
    const QuietPetsc quiet;
    const bool       krylov = !is(own_block_lanczos) && !preconditioned();
    // least dimension of the space beyond the modes: a space of few modes converges badly
    constexpr int spare_vectors = 20;
    const int     space         = std::min(size(), count + std::max(count, spare_vectors));
    require(EPSSetDimensions(get(), count, krylov ? space : PETSC_DEFAULT, PETSC_DEFAULT));
    require(EPSSolve(get()));
  }

  int n_found() const
  {
    int found = 0;
    EPSGetConverged(get(), &found);
    return found;
  }

  /// The lowest `count` modes; in several processes each has its own rows.
  LowestModes modes(int count) const
  {
    const QuietPetsc quiet;
    LowestModes      modes{VectorXd(count), MatrixXd::Zero(problem_.coordinates(), count), VectorXd(count)};
    const auto       shape = vector();
    for (int j = 0; j < count; ++j)
    {
      double square = 0.;
      require(EPSGetEigenpair(get(), j, &square, nullptr, shape.get(), nullptr));
      if (!(square > 0.))
        throw ConvergenceFailure("lowest modes: mode " + std::to_string(j + 1) + " has omega^2 = " +
                                 std::to_string(square) + "; the stiffness matrix must be positive definite");
      modes.omega(j) = std::sqrt(square);
      EPSGetErrorEstimate(get(), j, &modes.bound(j)); // of omega^2, relative
      modes.bound(j) *= 0.5;
      const PetscScalar *values = nullptr;
      VecGetArrayRead(shape.get(), &values);
      modes.V(problem_.free(), j) = Eigen::Map<const VectorXd>(values, problem_.rows());
      VecRestoreArrayRead(shape.get(), &values);
    }
    problem_.inverse()->complete(modes.V);
    return modes;
  }

  /// Further modes are sought orthogonal to these.
  void deflate(const MatrixXd &V)
  {
    std::vector<PetscOwned<Vec>> owned;
    std::vector<Vec>             columns;
    for (Eigen::Index j = 0; j < V.cols(); ++j)
    {
      owned.push_back(vector());
      columns.push_back(owned.back().get());
      set(columns.back(), V.col(j)(problem_.free()));
    }
    if (!columns.empty())
      require(EPSSetDeflationSpace(get(), int(columns.size()), columns.data()));
  }

  /// Sets the first motion: irregular, but always the same.
  void set_start()
  {
    const auto x = vector();
    VectorXd   values(problem_.rows());
    for (int i = 0; i < problem_.rows(); ++i)
      values(i) = std::fmod(0.6180339887498949 * double(problem_.inverse()->place(problem_.free()[i]) + 1), 1.) - 0.3;
    set(x.get(), values);
    Vec starts[] = {x.get()};
    require(EPSSetInitialSpace(get(), 1, starts));
  }

private:
  std::string slepc_name() const
  {
    std::string type = name_;
    if (type != own_block_lanczos)
      type.erase(std::remove(type.begin(), type.end(), '-'), type.end());
    return type;
  }

  bool preconditioned() const { return is(EPSLOBPCG) || is(EPSGD) || is(EPSJD) || is(EPSRQCG); }

  /// Sets the available inverse C^-1 as the operator or as a preconditioner.
  void set_transformation()
  {
    ST  st  = nullptr;
    KSP ksp = nullptr;
    PC  pc  = nullptr;
    require(EPSGetST(get(), &st));
    if (preconditioned())
    {
      // relative residual of methods that multiply by C: it stops at rounding
      constexpr double least_squares = 1e-8;
      constexpr int    max_steps     = 100000; // a safety net: each mode takes some tens
      require(EPSSetTolerances(get(), least_squares, max_steps));
      require(EPSSetWhichEigenpairs(get(), EPS_SMALLEST_REAL));
      require(STSetType(st, STPRECOND));
    }
    else
    {
      require(EPSSetWhichEigenpairs(get(), EPS_TARGET_MAGNITUDE));
      require(EPSSetTarget(get(), 0.));
      require(STSetType(st, STSINVERT));
    }
    require(STGetKSP(st, &ksp));
    require(KSPSetType(ksp, KSPPREONLY));
    require(KSPGetPC(ksp, &pc));
    require(PCSetType(pc, PCCHOLESKY));
    require(PCFactorSetMatSolverType(pc, own_factor));
  }

  PetscOwned<Vec> vector() const
  {
    Vec x = nullptr;
    require(MatCreateVecs(M_.get(), &x, nullptr));
    return PetscOwned<Vec>(x);
  }

  void set(Vec x, const VectorXd &values) const
  {
    PetscScalar *to = nullptr;
    VecGetArrayWrite(x, &to);
    std::copy_n(values.data(), values.size(), to);
    VecRestoreArrayWrite(x, &to);
  }

  const ModeProblem &problem_;
  std::string        name_;
  PetscOwned<Mat>    C_, M_;
  PetscOwned<EPS>    eps_;
};

/// A search by block Lanczos as a type of SLEPc, which continues with the space that it has.
class ContinuedSearch final : public ModeSearch
{
public:
  ContinuedSearch(EigenSolver solver, std::unique_ptr<const ModeProblem> problem)
      : problem_(std::move(problem)), solver_(std::move(solver))
  {
  }

  void        find(int count) override { solver_.solve(std::max(count, 1)); } // SLEPc needs one at least
  LowestModes modes(int count) const override { return solver_.modes(count); }
  Gap         gap_above(int count) const override { return block_lanczos_of(solver_.get()).gap_above(count); }

private:
  std::unique_ptr<const ModeProblem> problem_;
  EigenSolver                        solver_;
};

} // namespace

std::unique_ptr<ModeSearch> search_modes(MPI_Comm comm, const ModePencil &pencil, const std::string &eigensolver,
                                         const BlockLanczos::Options &options, const LowestModes &known)
{
  fem::petsc_session();
  register_own_types();
  auto        problem = std::make_unique<const ModeProblem>(pencil.inverse, *pencil.M, pencil.C);
  EigenSolver first(comm, *problem, eigensolver);
  if (first.is(own_block_lanczos))
  {
    set_block_lanczos(first.get(), options, known);
    return std::make_unique<ContinuedSearch>(std::move(first), std::move(problem));
  }
  const int  n = problem->coordinates(), most = first.size();
  const auto further = [comm, eigensolver,
                        problem = std::shared_ptr<const ModeProblem>(std::move(problem))](int count, const MatrixXd &V)
  {
    EigenSolver solver(comm, *problem, eigensolver);
    solver.deflate(V);
    solver.set_start();
    solver.solve(count);
    return solver.modes(std::min(count, solver.n_found()));
  };
  return std::make_unique<DeflatedSearch>(n, most, further, known);
}

} // namespace gestell::coupling
