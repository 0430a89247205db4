#pragma once

#include "apps/peers/stepper.h"

#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>

namespace gestell::peers
{

inline double *values(N_Vector x)
{
  return N_VGetArrayPointer(x);
}

/// The context, vectors and linear solver of a SUNDIALS integrator; freed in the right order.
class SundialsParts
{
public:
  /// @param with_solver  false: explicit integrators
  SundialsParts(Callbacks &callbacks, const PeerProblem &problem, const PeerOptions &options, bool with_solver);
  ~SundialsParts();
  SundialsParts(const SundialsParts &)            = delete;
  SundialsParts &operator=(const SundialsParts &) = delete;

  /// A vector of 2 n numbers, owned by this object.
  N_Vector vector();

  SUNContext      context;
  N_Vector        y;                ///< starts as (q, v)
  N_Vector        weights;          ///< absolute tolerances
  SUNMatrix       matrix = nullptr; ///< dense, or a placeholder for the condensed one
  SUNLinearSolver solver = nullptr;
  std::string     failure;

private:
  std::vector<N_Vector> vectors_;
  long                  n_;
};

/// Functions that have a different name in each integrator of SUNDIALS.
struct SundialsCalls
{
  int (*interpolate)(void *memory, double t, int derivative, N_Vector y);
  int (*root_info)(void *memory, int *found);
  int (*root_directions)(void *memory, int *directions);
  int (*no_inactive_root_warning)(void *memory);
};

/// Common part of the SUNDIALS integrators as Steppers.
class SundialsStepper : public Stepper
{
public:
  double             time() const final { return t_; }
  const double      *state() const final { return values(parts_.y); }
  const std::string &failure() const final { return parts_.failure; }
  void               interpolate(double t, double *y) final;
  void               restart(double t, const double *y) final;
  void               watch(const std::vector<int> &directions) final;
  int                root() final;
  void               count(coupling::IntegrationWork &work) final;

protected:
  /// @param with_solver  false: explicit integrators
  SundialsStepper(const SundialsCalls &calls, Callbacks &callbacks, const PeerProblem &problem,
                  const PeerOptions &options, bool with_solver);

  SundialsParts parts_;
  void         *memory_ = nullptr; ///< of the integrator: allocated and freed by the derived class
  double        t_, end_;

private:
  virtual void                      begin_again()            = 0; ///< at t_ with parts_.y
  virtual int                       watch_guards(int n)      = 0; ///< 0: none
  virtual coupling::IntegrationWork work_since_begin() const = 0;

  SundialsCalls             calls_;
  N_Vector                  output_;
  std::vector<int>          found_;
  coupling::IntegrationWork past_; ///< before the last restart, because integrators restart their counters
};

/// Values of the guards, with the signature of integrators of y' = f(t, y).
int guard_values(double t, N_Vector y, double *g, void *callbacks);

/// y' = f(t, y), with their signature.
int state_rate(double t, N_Vector y, N_Vector y_rate, void *callbacks);

/// Stores a library's error message; its parameter is the string.
void keep_message(int code, const char *module, const char *function, char *message, void *text);

/// Throws std::invalid_argument if a set-up call of a library returned an error.
void expect(int code, const char *call);

/// A "matrix" without entries, for linear systems that are solved by our own solver.
SUNMatrix empty_matrix(SUNContext context);

/// A solver that solves by FirstOrderForm::solve_rate_form (or _residual_form), factorised in the callback that sets up
/// its matrix.
enum class Form
{
  rate,
  residual
};
SUNLinearSolver condensed_solver(FirstOrderForm &form, Form which, SUNContext context);

} // namespace gestell::peers
