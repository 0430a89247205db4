#include "apps/peers/sundials.h"

#include <Eigen/Core>
#include <sundials/sundials_nvector.h>
#include <sundials/sundials_version.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <algorithm>
#include <cmath>

#ifndef SUN_COMM_NULL // before SUNDIALS 7
#define SUN_COMM_NULL nullptr
#endif

namespace gestell::peers
{
namespace
{

using Array = Eigen::Map<Eigen::ArrayXd>;

Array of(N_Vector x)
{
  return {N_VGetArrayPointer(x), N_VGetLength(x)};
}

void linear_sum(double a, N_Vector x, double b, N_Vector y, N_Vector z)
{
  of(z) = a * of(x) + b * of(y);
}
void fill(double c, N_Vector z)
{
  of(z).setConstant(c);
}
void product(N_Vector x, N_Vector y, N_Vector z)
{
  of(z) = of(x) * of(y);
}
void quotient(N_Vector x, N_Vector y, N_Vector z)
{
  of(z) = of(x) / of(y);
}
void scale(double c, N_Vector x, N_Vector z)
{
  of(z) = c * of(x);
}
void magnitude(N_Vector x, N_Vector z)
{
  of(z) = of(x).abs();
}
void inverse(N_Vector x, N_Vector z)
{
  of(z) = of(x).inverse();
}
void add_constant(N_Vector x, double b, N_Vector z)
{
  of(z) = of(x) + b;
}
double dot(N_Vector x, N_Vector y)
{
  return (of(x) * of(y)).sum();
}
double largest(N_Vector x)
{
  return of(x).abs().maxCoeff();
}
double smallest(N_Vector x)
{
  return of(x).minCoeff();
}
double weighted_rms(N_Vector x, N_Vector w)
{
  return std::sqrt((of(x) * of(w)).square().sum() / double(N_VGetLength(x)));
}
double weighted_l2(N_Vector x, N_Vector w)
{
  return std::sqrt((of(x) * of(w)).square().sum());
}

/// z = sum c_k x_k, where z may be one of the x_k: piece by piece, in a register or two.
int combination(int n_vectors, double *c, N_Vector *x, N_Vector z)
{
  constexpr Eigen::Index piece = 32; // stays in the first-level cache while all vectors are added
  Array                  sum   = of(z);
  for (Eigen::Index i = 0; i < sum.size(); i += piece)
  {
    const Eigen::Index                                        n    = std::min(piece, sum.size() - i);
    Eigen::Array<double, Eigen::Dynamic, 1, 0, int(piece), 1> part = c[0] * of(x[0]).segment(i, n);
    for (int k = 1; k < n_vectors; ++k)
      part += c[k] * of(x[k]).segment(i, n);
    sum.segment(i, n) = part;
  }
  return 0;
}

/// z_k = a_k x + y_k.
int scale_add(int n_vectors, double *a, N_Vector x, N_Vector *y, N_Vector *z)
{
  for (int k = 0; k < n_vectors; ++k)
    of(z[k]) = a[k] * of(x) + of(y[k]);
  return 0;
}

/// Replaces the arithmetic of a serial vector, and of all that are cloned from it, by loops compiled like the rest of
/// this program.  Distributed binaries of SUNDIALS are built for any processor; they would take most of the time.
void use_native_arithmetic(N_Vector x)
{
  N_Vector_Ops ops         = x->ops;
  ops->nvlinearsum         = linear_sum;
  ops->nvconst             = fill;
  ops->nvprod              = product;
  ops->nvdiv               = quotient;
  ops->nvscale             = scale;
  ops->nvabs               = magnitude;
  ops->nvinv               = inverse;
  ops->nvaddconst          = add_constant;
  ops->nvdotprod           = dot;
  ops->nvmaxnorm           = largest;
  ops->nvmin               = smallest;
  ops->nvwrmsnorm          = weighted_rms;
  ops->nvwl2norm           = weighted_l2;
  ops->nvlinearcombination = combination;
  ops->nvscaleaddmulti     = scale_add;
}

SUNMatrix_ID matrix_id(SUNMatrix)
{
  return SUNMATRIX_CUSTOM;
}
int matrix_zero(SUNMatrix)
{
  return 0;
}
void matrix_destroy(SUNMatrix A)
{
  SUNMatFreeEmpty(A);
}

struct CondensedSolver
{
  FirstOrderForm *form;
  Form            which;
};

SUNLinearSolver_Type solver_type(SUNLinearSolver)
{
  return SUNLINEARSOLVER_DIRECT;
}
SUNLinearSolver_ID solver_id(SUNLinearSolver)
{
  return SUNLINEARSOLVER_CUSTOM;
}
int solver_ready(SUNLinearSolver)
{
  return 0;
}
int solver_setup(SUNLinearSolver, SUNMatrix)
{
  return 0;
}
int solver_solve(SUNLinearSolver solver, SUNMatrix, N_Vector x, N_Vector b, sunrealtype)
{
  const auto &own = *static_cast<CondensedSolver *>(solver->content);
  if (x != b)
    N_VScale(1., b, x);
  if (own.which == Form::rate)
    own.form->solve_rate_form(values(x));
  else
    own.form->solve_residual_form(values(x));
  return 0;
}
sunindextype solver_flag(SUNLinearSolver)
{
  return 0;
}
int solver_free(SUNLinearSolver solver)
{
  delete static_cast<CondensedSolver *>(solver->content);
  SUNLinSolFreeEmpty(solver);
  return 0;
}

void add(coupling::IntegrationWork &sum, const coupling::IntegrationWork &part)
{
  sum.steps += part.steps;
  sum.rejected += part.rejected;
  sum.newton += part.newton;
  sum.factorisations += part.factorisations;
  sum.solves += part.solves;
}

} // namespace

SUNMatrix empty_matrix(SUNContext context)
{
  SUNMatrix A     = SUNMatNewEmpty(context);
  A->ops->getid   = matrix_id;
  A->ops->zero    = matrix_zero;
  A->ops->destroy = matrix_destroy;
  return A;
}

SUNLinearSolver condensed_solver(FirstOrderForm &form, Form which, SUNContext context)
{
  SUNLinearSolver solver  = SUNLinSolNewEmpty(context);
  solver->content         = new CondensedSolver{&form, which};
  solver->ops->gettype    = solver_type;
  solver->ops->getid      = solver_id;
  solver->ops->initialize = solver_ready;
  solver->ops->setup      = solver_setup;
  solver->ops->solve      = solver_solve;
  solver->ops->lastflag   = solver_flag;
  solver->ops->free       = solver_free;
  return solver;
}

SundialsParts::SundialsParts(Callbacks &callbacks, const PeerProblem &problem, const PeerOptions &options,
                             bool with_solver)
    : n_(2 * problem.q.size())
{
  SUNContext_Create(SUN_COMM_NULL, &context);
#if SUNDIALS_VERSION_MAJOR >= 7
  SUNContext_ClearErrHandlers(context);
  SUNContext_PushErrHandler(
      context,
      [](int, const char *function, const char *, const char *message, SUNErrCode code, void *text, SUNContext)
      { keep_message(code, function, "", const_cast<char *>(message), text); },
      &failure);
#endif
  y = vector();
  N_VEnableFusedOps_Serial(y, SUNTRUE); // clones inherit it
  if (options.vectors == PeerVectors::native)
    use_native_arithmetic(y);
  weights = vector();
  Eigen::Map<Eigen::VectorXd>(values(y), n_) << problem.q, problem.v;
  Eigen::Map<Eigen::VectorXd>(values(weights), n_) << problem.q_scale, problem.v_scale;
  N_VScale(options.tolerance, weights, weights);
  if (!with_solver)
    return;
  if (options.solver == PeerSolver::condensed)
  {
    matrix = empty_matrix(context);
    solver = condensed_solver(callbacks.form, options.kind == PeerKind::ida ? Form::residual : Form::rate, context);
  }
  else
  {
    matrix = SUNDenseMatrix(n_, n_, context);
    solver = SUNLinSol_Dense(y, matrix, context);
  }
}

SundialsParts::~SundialsParts()
{
  if (solver)
    SUNLinSolFree(solver);
  if (matrix)
    SUNMatDestroy(matrix);
  for (N_Vector x : vectors_)
    N_VDestroy(x);
  SUNContext_Free(&context);
}

N_Vector SundialsParts::vector()
{
  vectors_.push_back(vectors_.empty() ? N_VNew_Serial(n_, context) : N_VClone(vectors_.front()));
  return vectors_.back();
}

SundialsStepper::SundialsStepper(const SundialsCalls &calls, Callbacks &callbacks, const PeerProblem &problem,
                                 const PeerOptions &options, bool with_solver)
    : parts_(callbacks, problem, options, with_solver), t_(problem.t), end_(problem.samples.back()), calls_(calls),
      output_(parts_.vector())
{
}

void SundialsStepper::interpolate(double t, double *y)
{
  calls_.interpolate(memory_, t, 0, output_);
  std::copy(values(output_), values(output_) + N_VGetLength(output_), y);
}

void SundialsStepper::restart(double t, const double *y)
{
  add(past_, work_since_begin());
  t_ = t;
  std::copy(y, y + N_VGetLength(parts_.y), values(parts_.y));
  begin_again();
}

void SundialsStepper::watch(const std::vector<int> &directions)
{
  found_.assign(directions.size(), 0);
  expect(watch_guards(0), "RootInit");
  expect(watch_guards(int(directions.size())), "RootInit");
  std::vector<int> copy = directions;
  if (!copy.empty())
    expect(calls_.root_directions(memory_, copy.data()), "SetRootDirection");
  calls_.no_inactive_root_warning(memory_);
}

int SundialsStepper::root()
{
  calls_.root_info(memory_, found_.data());
  const auto crossed = std::find_if(found_.begin(), found_.end(), [](int sign) { return sign != 0; });
  return crossed == found_.end() ? 0 : int(crossed - found_.begin());
}

void SundialsStepper::count(coupling::IntegrationWork &work)
{
  add(work, past_);
  add(work, work_since_begin());
}

int guard_values(double t, N_Vector y, double *g, void *callbacks)
{
  static_cast<Callbacks *>(callbacks)->guards(t, values(y), g);
  return 0;
}

int state_rate(double t, N_Vector y, N_Vector y_rate, void *callbacks)
{
  static_cast<Callbacks *>(callbacks)->form.rate(t, values(y), values(y_rate));
  return 0;
}

void keep_message(int code, const char *module, const char *, char *message, void *text)
{
  if (code < 0)
    *static_cast<std::string *>(text) = std::string(module) + ": " + message;
}

void expect(int code, const char *call)
{
  if (code < 0)
    throw std::invalid_argument(std::string("peers: ") + call + " returned " + std::to_string(code));
}

bool peers_available()
{
  return true;
}

std::string peer_version()
{
  char version[64] = "";
  SUNDIALSGetVersion(version, sizeof version);
  return std::string("SUNDIALS ") + version;
}

} // namespace gestell::peers
