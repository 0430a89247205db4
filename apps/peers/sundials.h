#pragma once

#include "apps/peers/stepper.h"

#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>

namespace gestell::peers
{

/// The context, vectors and linear solver a SUNDIALS integrator needs; freed in the right order.
class SundialsParts
{
public:
  /// @param with_solver  false: explicit integrators
  SundialsParts(Callbacks &callbacks, const PeerProblem &problem, const PeerOptions &options, bool with_solver);
  ~SundialsParts();
  SundialsParts(const SundialsParts &)            = delete;
  SundialsParts &operator=(const SundialsParts &) = delete;

  /// A vector of 2 n numbers, freed with this.
  N_Vector vector();

  SUNContext      context;
  N_Vector        y;                ///< starts as (q, v)
  N_Vector        weights;          ///< absolute tolerances
  SUNMatrix       matrix = nullptr; ///< dense, or a name for the condensed one
  SUNLinearSolver solver = nullptr;
  std::string     failure;

private:
  std::vector<N_Vector> vectors_;
  long                  n_;
};

inline double *values(N_Vector x)
{
  return N_VGetArrayPointer(x);
}

/// Keeps what a library says about its failure; its parameter is the string.
void keep_message(int code, const char *module, const char *function, char *message, void *text);

/// Throws std::invalid_argument if a set-up call of a library returned an error.
void expect(int code, const char *call);

/// A "matrix" without entries for linear systems that are solved by a solver of our own.
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
