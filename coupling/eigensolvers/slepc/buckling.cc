#include "coupling/eigensolvers/slepc/buckling.h"

#include "coupling/eigensolvers/slepc/registered_types.h"
#include "coupling/integration/system/convergence_failure.h"
#include "fem/parallel/petsc_session.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gestell::coupling
{

namespace
{

/// Rethrows what a callback threw; else PETSc's message.
void require_solved(PetscErrorCode code, const ModeProblem &problem)
{
  if (problem.failure)
    std::rethrow_exception(std::exchange(problem.failure, nullptr));
  if (code != 0)
    throw ConvergenceFailure("prestress: the search for the buckling factor failed: " + QuietPetsc::message());
}

constexpr double tolerance  = 1e-8; // relative residual; that of the factor is its square
constexpr double of_tension = 1e-4; // least compression that counts beside the tension

PetscErrorCode prepare(EPS eps, Mat K, Mat C, int n)
{
  ST            st           = nullptr;
  KSP           ksp          = nullptr;
  PC            pc           = nullptr;
  constexpr int space        = 40;   // vectors: buckling loads of plates lie close together
  constexpr int max_restarts = 1000; // a safety net
  PetscCall(EPSSetOperators(eps, K, C));
  PetscCall(EPSSetProblemType(eps, EPS_GHEP));
  PetscCall(EPSSetType(eps, EPSKRYLOVSCHUR));
  PetscCall(EPSSetWhichEigenpairs(eps, EPS_LARGEST_MAGNITUDE));
  PetscCall(EPSSetDimensions(eps, 1, std::min(n, space), PETSC_DEFAULT));
  PetscCall(EPSSetTolerances(eps, tolerance, max_restarts));
  PetscCall(EPSSetPurify(eps, PETSC_FALSE));
  PetscCall(EPSGetST(eps, &st));
  PetscCall(STGetKSP(st, &ksp));
  PetscCall(KSPSetType(ksp, KSPPREONLY));
  PetscCall(KSPGetPC(ksp, &pc));
  PetscCall(PCSetType(pc, PCCHOLESKY));
  return PCFactorSetMatSolverType(pc, own_factor);
}

/// Solves and returns the first eigenvalue.
double first_eigenvalue(EPS eps, const ModeProblem &problem)
{
  int    found = 0;
  double kappa = 0.;
  require_solved(EPSSolve(eps), problem);
  require_solved(EPSGetConverged(eps, &found), problem);
  if (found == 0)
    throw ConvergenceFailure("prestress: the buckling factor is not found; use a finer mesh or other supports");
  require_solved(EPSGetEigenvalue(eps, 0, &kappa, nullptr), problem);
  return kappa;
}

} // namespace

double buckling_factor(std::shared_ptr<const InverseStiffness> inverse, const Eigen::SparseMatrix<double> &C,
                       const Eigen::SparseMatrix<double> &K)
{
  fem::petsc_session();
  register_own_types();
  const QuietPetsc  quiet;
  const ModeProblem problem(std::move(inverse), K, &C);
  const auto        on_K = mass_operator(MPI_COMM_SELF, problem), on_C = stiffness_operator(MPI_COMM_SELF, problem);
  const auto        require = [&](PetscErrorCode code) { require_solved(code, problem); };
  EPS               created = nullptr;
  require(EPSCreate(MPI_COMM_SELF, &created));
  const PetscOwned<EPS> eps(created);
  require(prepare(eps.get(), on_K.get(), on_C.get(), problem.rows()));
  const double largest = first_eigenvalue(eps.get(), problem);
  if (largest == 0.)
    return INFINITY;
  if (largest < 0.)
    return -1. / largest;
  // Tension dominates: the lowest eigenvalue, which may be one of many next to zero.
  require(EPSSetWhichEigenpairs(eps.get(), EPS_SMALLEST_REAL));
  require(EPSSetConvergenceTest(eps.get(), EPS_CONV_ABS));
  require(EPSSetTolerances(eps.get(), of_tension * largest, PETSC_DEFAULT));
  if (first_eigenvalue(eps.get(), problem) > -of_tension * largest)
    return INFINITY;
  require(EPSSetConvergenceTest(eps.get(), EPS_CONV_REL));
  require(EPSSetTolerances(eps.get(), tolerance, PETSC_DEFAULT));
  return -1. / first_eigenvalue(eps.get(), problem);
}

} // namespace gestell::coupling
